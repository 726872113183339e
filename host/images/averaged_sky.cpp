#include "images/averaged_sky.h"

#include <utility>

namespace prelight {

Environment averagedTo(Environment sky, int width) {
  while (sky.width > width && sky.width % 2 == 0 && sky.height % 2 == 0) {
    Environment half{sky.width / 2, sky.height / 2, {}};
    for (int y = 0; y < half.height; ++y) {
      for (int x = 0; x < half.width; ++x) {
        const glm::vec3* upper = &sky.radiance[static_cast<std::size_t>(2 * y) * sky.width + 2 * x];
        const glm::vec3* lower = upper + sky.width;
        half.radiance.push_back(0.25f * (upper[0] + upper[1] + lower[0] + lower[1]));
      }
    }
    sky = std::move(half);
  }
  return sky;
}

}  // namespace prelight
