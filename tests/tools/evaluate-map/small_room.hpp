#pragma once

#include <filesystem>

#include "pipeline/scene/labelled_point.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tiny_sequence.hpp"
#include "tools/truth/true_sequence.hpp"

namespace sediment::test {

/// A sequence on disk with exact truth. The world is z up; the camera is at height 1 m, y = 0, and looks
/// along +y at a wall (a tv by its label) at y = 2 m. In frame 1 of 3 a person, a square at y = 1.01 m,
/// covers the middle of the image. The truth is the part of the wall that every frame sees, 1 cm apart.
struct SmallRoom {
  SmallRoom();

  LabelledCloud wall() const;    ///< as in the truth
  LabelledCloud person() const;  ///< the person's surface as the camera sees it, in cells of 1 cm
  tools::TrueSequence open() const { return tools::open_true_sequence(folder.path()); }

  TemporaryFolder folder;
};

/// Every point moved.
LabelledCloud moved(LabelledCloud cloud, const Pose& by);
LabelledCloud operator+(LabelledCloud a, const LabelledCloud& b);

}  // namespace sediment::test
