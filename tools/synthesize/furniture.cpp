#include "tools/synthesize/furniture.hpp"

#include <cmath>
#include <numbers>

#include "tools/synthesize/palette.hpp"
#include "tools/synthesize/patterns.hpp"

namespace sediment::synthetic {
namespace {

constexpr double kDeskTop = 0.74;

void place_desk(Workshop& w, Vec3 foot, double width, double yaw) {
  const double depth = 0.8;
  const int top = w.sheet(wood(w.random.next(), {.62f, .46f, .30f}), width, depth);
  const int side = w.tiled(wood(w.random.next(), {.55f, .42f, .30f}), 0.8),
            metal = w.plain({.35f, .36f, .38f});
  std::vector<Solid> parts{box({0, 0, kDeskTop - 0.015}, {width, depth, 0.03}, side, kTop, top),
                           box({0, depth / 2 - 0.05, 0.5}, {width - 0.12, 0.02, 0.35}, side)};
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      parts.push_back(
          box({x * (width / 2 - 0.04), y * (depth / 2 - 0.04), 0.355}, {0.05, 0.05, 0.71}, metal));
  w.add("desk", "desk", false, moved(std::move(parts), placed(foot, yaw)));
}

void place_screen(Workshop& w, const Pose& on_desk) {
  const double width = 0.52, height = 0.32;
  const int picture =
      w.sheet(screen(w.random.next(), width - 0.02, height - 0.02), width - 0.02, height - 0.02);
  w.material(picture).glow = 0.75f;
  w.material(picture).depth_loss = 0.25f;
  const int black = w.plain({.11f, .11f, .12f});
  w.add("screen", "tv", true,
        moved({box({0, 0, 0.29}, {width, 0.035, height}, black),
               box({0, -0.0185, 0.29}, {width - 0.02, 0.002, height - 0.02}, black, kFront, picture),
               box({0, 0.03, 0.10}, {0.06, 0.02, 0.2}, black),
               box({0, 0.02, 0.006}, {0.24, 0.18, 0.012}, black)},
              on_desk));
}

void place_keyboard(Workshop& w, const Pose& on_desk) {
  const double width = 0.44, depth = 0.145;
  const int keys = w.sheet(keyboard(w.random.next(), width, depth), width, depth, 0.7);
  w.add("keyboard", "keyboard", true,
        moved({box({0, 0, 0.01}, {width, depth, 0.02}, w.plain({.12f, .12f, .13f}), kTop, keys)}, on_desk));
  w.add("mouse", "mouse", true,
        moved({limb({0.3, -0.03, 0.012}, {0.3, 0.03, 0.012}, 0.028, 0.024, w.plain({.2f, .2f, .22f}))},
              on_desk));
}

void place_cup(Workshop& w, Vec3 foot) {
  const int glaze = w.tiled(cloth(w.random.next(), pigment(w.random), 1), 0.3);
  w.add("cup", "cup", true,
        {pillar(foot, 0.04, 0.10, glaze), box(foot + Vec3{0.05, 0, 0.05}, {0.02, 0.012, 0.06}, glaze)});
}

void place_bottle(Workshop& w, Vec3 foot) {
  const int glass = w.plain({.22f, .48f, .35f}),
            label = w.sheet(poster(w.random.next(), 0.22, 0.1), 0.22, 0.1, 0.7);
  w.add("bottle", "bottle", true,
        {pillar(foot, 0.034, 0.17, glass), pillar(foot + Vec3{0, 0, 0.05}, 0.035, 0.09, label),
         pillar(foot + Vec3{0, 0, 0.17}, 0.014, 0.07, glass)});
}

// A book that stands with its back to -y (or lies).
void place_book(Workshop& w, const Pose& at, double thick, double height, bool lying) {
  const double depth = w.random.uniform(0.15, 0.2);
  const int spine = w.sheet(book_spine(w.random.next(), thick, height), thick, height, 0.8);
  Solid book = box({0, 0, height / 2}, {thick, depth, height}, w.plain(pigment(w.random)), kFront, spine);
  if (lying) {
    const int front = w.sheet(poster(w.random.next(), depth, height), depth, height, 0.8);
    book = box({0, 0, thick / 2}, {depth, height, thick}, w.plain({.9f, .88f, .8f}), kTop, front);
  }
  w.add("book", "book", true, moved({book}, at));
}

void place_shelf(Workshop& w, Vec3 foot, double yaw) {
  const double width = 1.2, depth = 0.3, height = 2.0;
  const int plank = w.tiled(wood(w.random.next(), {.58f, .40f, .26f}), 1.0);
  const Pose pose = placed(foot, yaw);
  std::vector<Solid> parts{box({-width / 2, 0, height / 2}, {0.025, depth, height}, plank),
                           box({width / 2, 0, height / 2}, {0.025, depth, height}, plank),
                           box({0, depth / 2 - 0.006, height / 2}, {width, 0.012, height}, plank)};
  const double rise = 0.385;
  for (int level = 0; level <= 5; ++level)
    parts.push_back(box({0, 0, 0.05 + rise * level}, {width - 0.02, depth, 0.025}, plank));
  w.add("shelf", "shelf", false, moved(std::move(parts), pose));
  for (int level = 0; level < 5; ++level) {
    double x = -width / 2 + 0.03;
    while (x < width / 2 - 0.09) {
      if (w.random.chance(0.12)) {  // a gap
        x += w.random.uniform(0.05, 0.15);
        continue;
      }
      const double thick = w.random.uniform(0.022, 0.06), tall = w.random.uniform(0.2, 0.32);
      place_book(w, pose * placed({x + thick / 2, -w.random.uniform(0, 0.05), 0.063 + rise * level}), thick,
                 tall, false);
      x += thick + w.random.uniform(0.001, 0.004);
    }
  }
}

void place_cabinet(Workshop& w, Vec3 foot, double yaw) {
  const int body = w.tiled(wood(w.random.next(), {.50f, .47f, .44f}), 1.0),
            handle = w.plain({.75f, .75f, .77f});
  std::vector<Solid> parts{box({0, 0, 0.55}, {0.9, 0.45, 1.1}, body)};
  for (const double x : {-0.225, 0.225})
    for (const double z : {0.3, 0.8}) {
      const int door = w.sheet(wood(w.random.next(), {.66f, .60f, .52f}), 0.42, 0.46);
      parts.push_back(box({x, -0.232, z}, {0.42, 0.016, 0.46}, body, kFront, door));
      parts.push_back(box({x, -0.25, z + 0.15}, {0.12, 0.02, 0.015}, handle));
    }
  w.add("cabinet", "cabinet", false, moved(std::move(parts), placed(foot, yaw)));
}

void place_plant(Workshop& w, Vec3 foot) {
  const int pot = w.plain({.62f, .33f, .22f}), stem = w.plain({.33f, .26f, .15f});
  const int leaf = w.tiled(cloth(w.random.next(), {.20f, .48f, .18f}, 1), 0.4);
  std::vector<Solid> parts{pillar(foot, 0.14, 0.28, pot), pillar(foot + Vec3{0, 0, 0.28}, 0.015, 0.5, stem)};
  for (int k = 0; k < 16; ++k) {
    const double angle = 2.4 * k, reach = 0.14 + 0.16 * w.random.uniform(), z = 0.45 + 0.035 * k;
    const Vec3 base = foot + Vec3{0, 0, z};
    const Vec3 tip =
        base + Vec3{reach * std::cos(angle), reach * std::sin(angle), w.random.uniform(0.02, 0.15)};
    parts.push_back(limb(base, tip, 0.012, 0.045, leaf, 0.35, {-std::sin(angle), std::cos(angle), 0}));
  }
  w.add("plant", "potted plant", true, std::move(parts));
}

void dress_desk(Workshop& w, const Pose& desk, bool two_screens) {
  const auto on_top = [&](double x, double y, double yaw) { return desk * placed({x, y, kDeskTop}, yaw); };
  place_screen(w, on_top(two_screens ? -0.35 : 0.05, 0.15, 0.12));
  if (two_screens) place_screen(w, on_top(0.27, 0.17, -0.15));
  place_keyboard(w, on_top(-0.05, -0.18, w.random.uniform(-0.1, 0.1)));
  place_cup(w, on_top(0.52, 0.2, 0).translation);
  place_bottle(w, on_top(-0.72, 0.05, 0).translation);
  double height = 0;
  for (int k = 0; k < 4; ++k) {
    const double thick = w.random.uniform(0.025, 0.05);
    place_book(w, on_top(0.68, 0.12, w.random.uniform(-0.4, 0.4)) * placed({0, 0, height}), thick, 0.25,
               true);
    height += thick;
  }
  place_book(w, on_top(-0.52, -0.2, 0.5), 0.03, 0.24, true);
}

}  // namespace

std::vector<Solid> office_chair(Workshop& w, Rgb seat_color) {
  const int seat = w.tiled(cloth(w.random.next(), seat_color, 0), 0.8), metal = w.plain({.16f, .16f, .17f});
  std::vector<Solid> parts{
      box({0, 0, 0.47}, {0.48, 0.46, 0.08}, seat), box({0, 0.23, 0.80}, {0.44, 0.06, 0.46}, seat),
      box({0, 0.26, 0.58}, {0.07, 0.03, 0.3}, metal), pillar({0, 0, 0.09}, 0.03, 0.36, metal)};
  for (int leg = 0; leg < 5; ++leg) {
    const double angle = 2 * std::numbers::pi * leg / 5 + 0.3;
    const Vec3 end{0.29 * std::cos(angle), 0.29 * std::sin(angle), 0.065};
    parts.push_back(limb({0, 0, 0.1}, end, 0.025, 0.02, metal));
    parts.push_back(limb({end.x, end.y, 0.032}, {end.x + 0.005, end.y, 0.032}, 0.03, 0.03, metal));
  }
  for (const double x : {-0.27, 0.27}) {
    parts.push_back(box({x, 0.06, 0.56}, {0.03, 0.05, 0.2}, metal));
    parts.push_back(box({x, 0.02, 0.67}, {0.05, 0.26, 0.03}, metal));
  }
  return parts;
}

std::vector<Solid> carton(Workshop& w, Vec3 size) {
  Solid solid = box({0, 0, size.z / 2}, size, 0);
  for (int face = 0; face < kFaces; ++face) {
    const FaceRange face_m = face_range(solid, face);
    solid.materials[static_cast<std::size_t>(face)] =
        w.sheet(cardboard(w.random.next(), face_m.u_m, face_m.v_high_m), face_m.u_m, face_m.v_high_m);
  }
  return {solid};
}

void place_furniture(Workshop& w, RoomStyle style) {
  constexpr double kPi = std::numbers::pi;
  if (style == RoomStyle::bare) {
    w.add("box", "box", true, moved(carton(w, {0.42, 0.34, 0.3}), placed({1.5, 2.2, 0}, 0.25)));
    return;
  }
  place_desk(w, {-0.95, 1.85, 0}, 1.8, 0);
  place_desk(w, {0.9, 1.85, 0}, 1.8, 0);
  if (style == RoomStyle::furnished) {
    dress_desk(w, placed({-0.95, 1.85, 0}), true);
    dress_desk(w, placed({0.9, 1.85, 0}), false);
  }
  place_shelf(w, {-2.83, 1.0, 0}, kPi / 2);
  place_cabinet(w, {2.76, 0.35, 0}, -kPi / 2);
  place_plant(w, {2.55, 2.05, 0});
  w.add("box", "box", true, moved(carton(w, {0.5, 0.36, 0.34}), placed({2.6, -0.75, 0}, 1.4)));
  w.add("box", "box", true, moved(carton(w, {0.38, 0.3, 0.26}), placed({2.62, -0.72, 0.34}, 1.9)));
  w.add("box", "box", true, moved(carton(w, {0.42, 0.42, 0.4}), placed({2.7, 0.35, 1.1}, 1.45)));

  place_desk(w, {-1.0, -2.05, 0}, 1.8, kPi);
  if (style == RoomStyle::furnished) dress_desk(w, placed({-1.0, -2.05, 0}, kPi), true);
  place_cabinet(w, {1.3, -2.24, 0}, kPi);
}

}  // namespace sediment::synthetic
