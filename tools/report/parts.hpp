#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/scene/trajectory.hpp"
#include "tools/report/page.hpp"

namespace sediment::report {

// What a page shows of each kind of artifact. `id` is the content id of the artifact's folder: equal ids are
// read once. Every part says how much of the artifact it shows. All throw std::runtime_error naming the file.

/// {block, count, of, origin, step, labels}: `limit` points at most, spread evenly over the file. The block
/// holds x y z as 16-bit steps of each point, then r g b of each point, then an index into labels of each.
Json cloud_part(const std::filesystem::path& folder, const std::string& id, std::size_t limit, Page& page);

/// {block, count, of, origin, step, labels, resolution_m, level}: the occupied leaves at the finest level
/// that has `limit` at most. The block is that of a cloud (centres), then the level of each box: its side is
/// resolution_m * 2^level.
Json octree_part(const std::filesystem::path& folder, const std::string& id, std::size_t limit, Page& page);

/// {block, width, height, resolution_m, origin_m, map_from_world, source, counts}: the block is a PNG as in
/// map.pgm.
Json grid_part(const std::filesystem::path& folder, const std::string& id, Page& page);

/// Poses, what tracking says of each frame, and, if `truth` names a file, how far they are from it.
Json trajectory_part(const std::filesystem::path& folder, const std::filesystem::path& truth);

/// Every interaction that was decided: {classes, rows}, a row is stamp, ids and classes (indices) of the
/// dynamic and the static instance, pairs, metres, decision.
Json interactions_part(const std::filesystem::path& folder);

/// Where the frames of an instance come from; all but the sequence may be empty.
struct FrameFolders {
  std::filesystem::path sequence, masks, dynamic;
  std::string sequence_id, masks_id, dynamic_id;
};
/// {of, width, height, frames: [{index, stamp, image, masks, instances, features}]}: `limit` frames spread
/// over the sequence. `masks` is a PNG whose red is the number of the instance in the list (from 1) and
/// whose green is the value of the dynamic mask; `features` are pairs of 16-bit pixel coordinates.
Json frames_part(const Sequence& sequence, const FrameFolders& folders, std::size_t limit, Page& page);

/// `count` of `of` positions (all, if there are no more), one from each of `count` equal stretches and not
/// always at the same place in it, so that a regular order in a file leaves no pattern.
std::vector<std::size_t> spread(std::size_t count, std::size_t of);

}  // namespace sediment::report
