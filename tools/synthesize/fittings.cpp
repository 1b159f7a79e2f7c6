#include "tools/synthesize/fittings.hpp"

#include <numbers>

#include "tools/synthesize/palette.hpp"
#include "tools/synthesize/patterns.hpp"

namespace sediment::synthetic {
namespace {

constexpr double kPi = std::numbers::pi;

/// A wall as one looks at it: `at(u, z)` is a place on it, `u` metres to the right of its middle.
struct Wall {
  Vec3 middle;  ///< on the floor
  double yaw;   ///< turns a front of -y to where the wall looks
  Pose at(double u, double z) const { return placed(middle, yaw) * placed({u, 0, z}); }
};

void hang(Workshop& w, const std::string& name, const Pose& at, const Pattern& pattern, double width,
          double height) {
  const int print = w.sheet(pattern, width, height);
  w.add(name, "poster", false,
        moved({box({0, -0.006, 0}, {width, 0.012, height}, w.plain({.3f, .28f, .26f}), kFront, print)}, at));
}

void hang_poster(Workshop& w, const Wall& wall, double u, double z, double width, double height) {
  hang(w, "poster", wall.at(u, z), poster(w.random.next(), width, height), width, height);
}

void hang_board(Workshop& w, const Wall& wall, double u, double z, double width, double height) {
  hang(w, "pin board", wall.at(u, z), pin_board(w.random.next(), width, height), width, height);
}

void hang_whiteboard(Workshop& w, const Wall& wall, double u, double z) {
  constexpr double kWidth = 1.5, kHeight = 0.95;
  const int drawing = w.sheet(whiteboard(w.random.next(), kWidth, kHeight), kWidth, kHeight),
            frame = w.plain({.62f, .64f, .66f});
  std::vector<Solid> parts{box({0, -0.01, 0}, {kWidth, 0.02, kHeight}, frame, kFront, drawing),
                           box({0, -0.04, -kHeight / 2 - 0.01}, {kWidth * 0.7, 0.08, 0.015}, frame)};
  for (int pen = 0; pen < 4; ++pen)
    parts.push_back(box({-0.3 + 0.17 * pen, -0.045, -kHeight / 2 + 0.007}, {0.13, 0.018, 0.018},
                        w.plain(pigment(w.random))));
  w.add("whiteboard", "poster", false, moved(std::move(parts), wall.at(u, z)));
}

void hang_clock(Workshop& w, const Wall& wall, double u, double z) {
  const int face = w.sheet(clock_face(), 0.28, 0.28, 0.7);
  Solid disc = pillar({0, 0, 0}, 0.14, 0.03, w.plain({.15f, .15f, .16f}));
  disc.materials[2] = face;
  // Stand the cylinder up: its top looks to the front.
  const Pose lying = rotation_from({kPi / 2, 0, 0});
  w.add("clock", "clock", true, moved(moved({disc}, lying), wall.at(u, z)));
}

void hang_door(Workshop& w, const Wall& wall, double u, int leaf) {
  const int frame = w.plain({.48f, .45f, .42f}), metal = w.plain({.72f, .72f, .74f});
  w.add("door", "other furniture", false,
        moved({box({0, -0.015, 1.0}, {0.9, 0.03, 2.0}, frame, kFront, leaf),
               box({-0.5, -0.03, 1.03}, {0.1, 0.06, 2.06}, frame),
               box({0.5, -0.03, 1.03}, {0.1, 0.06, 2.06}, frame),
               box({0, -0.03, 2.05}, {1.1, 0.06, 0.1}, frame),
               box({0.36, -0.035, 1.0}, {0.05, 0.012, 0.22}, metal),
               limb({0.36, -0.07, 1.03}, {0.25, -0.07, 1.03}, 0.011, 0.011, metal)},
              wall.at(u, 0)));
}

void hang_radiator(Workshop& w, const Wall& wall, double u) {
  const int enamel = w.plain({.84f, .83f, .79f});
  std::vector<Solid> parts{box({0, -0.07, 0.42}, {1.1, 0.04, 0.52}, enamel)};
  for (int rib = 0; rib < 12; ++rib)
    parts.push_back(box({-0.5 + 0.091 * rib, -0.1, 0.42}, {0.045, 0.03, 0.5}, enamel));
  w.add("radiator", "other furniture", false, moved(std::move(parts), wall.at(u, 0)));
}

void fix_socket(Workshop& w, const Wall& wall, double u, double z) {
  const int plastic = w.plain({.9f, .89f, .85f}), dark = w.plain({.2f, .2f, .2f});
  std::vector<Solid> parts{box({0, -0.005, 0}, {0.16, 0.01, 0.08}, plastic)};
  for (const double x : {-0.055, -0.022, 0.022, 0.055})
    parts.push_back(box({x, -0.0105, 0}, {0.01, 0.002, 0.012}, dark));
  w.add("socket", "other furniture", false, moved(std::move(parts), wall.at(u, z)));
}

}  // namespace

void hang_fittings(Workshop& w) {
  const Vec3 low = w.scene.room_low, high = w.scene.room_high;
  const Wall back{{0, high.y, 0}, 0}, front{{0, low.y, 0}, kPi}, left{{low.x, 0, 0}, kPi / 2},
      right{{high.x, 0, 0}, -kPi / 2};
  hang_poster(w, back, -2.35, 1.75, 0.6, 0.85);
  hang_board(w, back, -1.15, 1.75, 1.3, 0.85);
  hang_poster(w, back, 0.05, 1.8, 0.55, 0.8);
  hang_poster(w, back, 0.95, 1.85, 0.8, 0.6);
  hang_poster(w, back, 2.0, 1.75, 0.6, 0.85);
  hang_clock(w, back, 1.5, 2.1);
  fix_socket(w, back, -0.3, 1.05);
  fix_socket(w, back, 1.75, 1.1);
  hang_poster(w, right, -0.95, 1.6, 0.7, 1.0);
  hang_poster(w, right, 0.2, 1.7, 0.6, 0.85);
  hang_board(w, right, 1.5, 1.6, 1.1, 0.8);
  hang_poster(w, right, -2.0, 1.65, 0.55, 0.8);
  hang_whiteboard(w, left, -0.75, 1.55);
  hang_radiator(w, left, -0.75);
  hang_poster(w, left, -2.0, 1.65, 0.6, 0.85);
  hang_poster(w, left, 2.05, 1.65, 0.6, 0.85);
  fix_socket(w, left, 0.2, 0.35);
  const int leaf = w.sheet(wood(w.random.next(), {.60f, .47f, .34f}), 0.9, 2.0);
  hang_door(w, front, -2.2, leaf);
  hang_poster(w, front, -1.15, 1.65, 0.6, 0.85);
  hang_board(w, front, 0.0, 1.65, 1.2, 0.8);
  hang_poster(w, front, 1.1, 1.65, 0.6, 0.85);
  hang_poster(w, front, 2.15, 1.6, 0.7, 1.0);
}

void hang_few_fittings(Workshop& w) {
  const Wall back{{0, w.scene.room_high.y, 0}, 0};
  const int leaf = w.sheet(plaster(w.random.next(), {.82f, .81f, .78f}, 0.015), 0.9, 2.0);
  hang_door(w, back, -1.9, leaf);
  hang_radiator(w, back, 2.2);
}

}  // namespace sediment::synthetic
