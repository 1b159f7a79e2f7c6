#include "tools/synthesize/palette.hpp"

#include <array>

namespace sediment::synthetic {

Rgb pigment(Random& random) {
  static constexpr std::array<Rgb, 18> kPigments{{{.70f, .20f, .17f},
                                                  {.83f, .42f, .20f},
                                                  {.88f, .69f, .28f},
                                                  {.47f, .50f, .20f},
                                                  {.23f, .45f, .29f},
                                                  {.16f, .48f, .50f},
                                                  {.24f, .44f, .68f},
                                                  {.16f, .24f, .44f},
                                                  {.40f, .28f, .48f},
                                                  {.68f, .36f, .45f},
                                                  {.45f, .29f, .20f},
                                                  {.64f, .52f, .38f},
                                                  {.24f, .24f, .26f},
                                                  {.52f, .56f, .60f},
                                                  {.55f, .14f, .24f},
                                                  {.36f, .60f, .74f},
                                                  {.78f, .56f, .50f},
                                                  {.30f, .36f, .22f}}};
  const Rgb base =
      kPigments[static_cast<std::size_t>(random.integer(0, static_cast<int>(kPigments.size()) - 1))];
  const double shift = random.uniform(-0.22, 0.25);
  return shift < 0 ? blend(base, gray(0.05), -shift) : blend(base, gray(0.95), shift);
}

Rgb pale(Random& random) {
  return blend(pigment(random), {.96f, .95f, .91f}, random.uniform(0.55, 0.95));
}

}  // namespace sediment::synthetic
