#include "tests/stages/sor/test_clouds.hpp"

#include <cmath>
#include <random>

namespace sediment::test {
namespace {

using Random = std::mt19937;

float uniform(Random& random, float low, float high) {
  return low + (high - low) * static_cast<float>(random()) / 4294967296.0f;
}

float normal(Random& random, float sigma) {
  return std::normal_distribution<float>(0, sigma)(random);
}

template <class Make>
LabelledCloud make(std::size_t size, Make position) {
  LabelledCloud cloud(size);
  for (std::size_t i = 0; i < size; ++i) {
    position(i, cloud[i]);
    cloud[i].label = static_cast<std::uint32_t>(i % 7);
    cloud[i].instance = static_cast<std::uint32_t>(i);
  }
  return cloud;
}

}  // namespace

LabelledCloud noisy_room(std::size_t size, std::uint32_t seed) {
  Random random(seed);
  const float extent[3] = {6, 5, 3};
  return make(size, [&](std::size_t i, LabelledPoint& p) {
    float at[3];
    for (int axis = 0; axis < 3; ++axis) at[axis] = uniform(random, 0, extent[axis]);
    if (i % 100 != 0) {
      const int wall = static_cast<int>(random() % 6);
      at[wall / 2] = (wall % 2 == 0 ? 0 : extent[wall / 2]) + normal(random, 0.005f);
    }
    p.x = at[0], p.y = at[1], p.z = at[2];
  });
}

std::vector<NamedCloud> awkward_clouds(std::size_t size, std::uint32_t seed) {
  Random random(seed);
  std::vector<NamedCloud> clouds;
  clouds.push_back({"room", noisy_room(size, seed)});
  clouds.push_back({"clusters", make(size, [&](std::size_t i, LabelledPoint& p) {
                      const float scale = std::pow(10.0f, static_cast<float>(i % 6) - 4);
                      const float center = 3 * static_cast<float>(i % 6);
                      p.x = center + normal(random, scale);
                      p.y = normal(random, scale);
                      p.z = center - normal(random, scale);
                    })});
  clouds.push_back({"duplicates", make(size, [&](std::size_t, LabelledPoint& p) {
                      const auto place = static_cast<float>(random() % 40);
                      p.x = place / 10, p.y = std::fmod(place, 7.0f), p.z = 0;
                      if (random() % 4 == 0) p.z = uniform(random, 0, 1);
                    })});
  clouds.push_back({"lattice", make(size, [&](std::size_t i, LabelledPoint& p) {
                      const auto n = static_cast<std::size_t>(std::cbrt(static_cast<double>(size))) + 1;
                      p.x = static_cast<float>(i % n), p.y = static_cast<float>(i / n % n),
                      p.z = static_cast<float>(i / n / n);
                    })});
  clouds.push_back({"far outliers", make(size, [&](std::size_t i, LabelledPoint& p) {
                      const float scale = i % 500 == 7 ? 3e4f : i % 500 == 9 ? 1e9f : 1;
                      p.x = uniform(random, -scale, scale), p.y = uniform(random, -scale, scale),
                      p.z = uniform(random, 0, scale);
                    })});
  clouds.push_back({"plane", make(size, [&](std::size_t, LabelledPoint& p) {
                      p.x = uniform(random, 0, 4), p.y = uniform(random, 0, 4);
                    })});
  clouds.push_back(
      {"line", make(size, [&](std::size_t, LabelledPoint& p) { p.y = uniform(random, -1, 1); })});
  clouds.push_back({"a million metres away", make(size, [&](std::size_t, LabelledPoint& p) {
                      p.x = 1e6f + uniform(random, 0, 20), p.y = -1e6f + uniform(random, 0, 20),
                      p.z = uniform(random, 0, 3);
                    })});
  return clouds;
}

}  // namespace sediment::test
