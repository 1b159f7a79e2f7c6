#include "tools/synthesize/room.hpp"

#include "tools/synthesize/fittings.hpp"
#include "tools/synthesize/furniture.hpp"
#include "tools/synthesize/palette.hpp"
#include "tools/synthesize/patterns.hpp"

namespace sediment::synthetic {
namespace {

constexpr double kHalfX = 3, kHalfY = 2.5, kHeight = 2.7, kThick = 0.1;

/// Materials of the room's sides.
struct Shell {
  int back, front, left, right, floor, ceiling;
};

Shell white_shell(Workshop& w, double x, double y) {
  const auto painted = [&](double tone, double contrast, double width, double height) {
    return w.sheet(plaster(w.random.next(), gray(tone), contrast), width, height, 2.2);
  };
  return {painted(0.86, 0.015, x, kHeight), painted(0.85, 0.015, x, kHeight),
          painted(0.87, 0.015, y, kHeight), painted(0.86, 0.015, y, kHeight),
          painted(0.45, 0.03, x, y),        painted(0.88, 0.015, x, y)};
}

Shell colored_shell(Workshop& w, double x, double y, double contrast) {
  const auto wall = [&](Rgb color, double width) {
    return w.sheet(plaster(w.random.next(), color, contrast), width, kHeight, 2.2);
  };
  const int back = wall({.80f, .79f, .74f}, x), front = wall({.76f, .79f, .80f}, x);
  const int left = wall({.82f, .76f, .66f}, y), right = wall({.70f, .76f, .74f}, y);
  const int floor = w.sheet(carpet(w.random.next(), {.36f, .38f, .44f}), x, y, 2.2);
  const int ceiling = w.sheet(ceiling_panels(w.random.next()), x, y, 3);
  return {back, front, left, right, floor, ceiling};
}

void build_shell(Workshop& w, RoomStyle style) {
  const double x = 2 * kHalfX, y = 2 * kHalfY;
  const auto [back, front, left, right, floor, ceiling] =
      style == RoomStyle::bare ? white_shell(w, x, y)
                               : colored_shell(w, x, y, style == RoomStyle::pale ? 0.25 : 1);
  const double middle = kHeight / 2;
  w.add("back wall", "wall", false, {box({0, kHalfY + kThick / 2, middle}, {x, kThick, kHeight}, back)});
  w.add("front wall", "wall", false, {box({0, -kHalfY - kThick / 2, middle}, {x, kThick, kHeight}, front)});
  w.add("left wall", "wall", false, {box({-kHalfX - kThick / 2, 0, middle}, {kThick, y, kHeight}, left)});
  w.add("right wall", "wall", false, {box({kHalfX + kThick / 2, 0, middle}, {kThick, y, kHeight}, right)});
  w.add("floor", "floor", false, {box({0, 0, -kThick / 2}, {x, y, kThick}, floor)});
  w.add("ceiling", "ceiling", false, {box({0, 0, kHeight + kThick / 2}, {x, y, kThick}, ceiling)});
  const int skirting = w.plain({.42f, .36f, .30f});
  w.add("skirting", "other furniture", false,
        {box({0, kHalfY - 0.008, 0.04}, {x, 0.016, 0.08}, skirting),
         box({0, -kHalfY + 0.008, 0.04}, {x, 0.016, 0.08}, skirting),
         box({-kHalfX + 0.008, 0, 0.04}, {0.016, y, 0.08}, skirting),
         box({kHalfX - 0.008, 0, 0.04}, {0.016, y, 0.08}, skirting)});
  w.scene.room_low = {-kHalfX, -kHalfY, 0};
  w.scene.room_high = {kHalfX, kHalfY, kHeight};
}

void hang_lamps(Workshop& w) {
  std::vector<Solid> panels;
  const int tube = w.plain({1.05f, 1.05f, 1.02f});
  w.material(tube).glow = 1;
  for (const double x : {-1.5, 1.5})
    for (const double y : {-1.0, 1.1}) {
      panels.push_back(
          box({x, y, kHeight - 0.02}, {1.2, 0.3, 0.04}, w.plain({.8f, .8f, .8f}), kBottom, tube));
      w.scene.lamps.push_back({{x, y, kHeight - 0.045}, 1.2, 0.3, {3.0f, 2.9f, 2.76f}});
    }
  w.add("lamps", "other furniture", false, std::move(panels));
  w.scene.thrown_back = {4.4f, 4.4f, 4.4f};
}

}  // namespace

void furnish(Workshop& workshop, RoomStyle style) {
  build_shell(workshop, style);
  hang_lamps(workshop);
  if (style == RoomStyle::furnished) hang_fittings(workshop);
  if (style == RoomStyle::bare) hang_few_fittings(workshop);
  place_furniture(workshop, style);
}

}  // namespace sediment::synthetic
