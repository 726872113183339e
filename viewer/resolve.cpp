#include "viewer/resolve.h"

namespace prelight::viewer {

void resolve(const gl::Framebuffer& samples, int samplesPerAxis, const Tile& tile, Picture& picture) {
  const std::vector<glm::vec4> values = samples.read();
  const float weight = 1.0f / static_cast<float>(samplesPerAxis * samplesPerAxis);
  for (int y = 0; y < tile.height; ++y) {
    const int firstRow = (tile.height - 1 - y) * samplesPerAxis;  // OpenGL's rows go upwards
    for (int x = 0; x < tile.width; ++x) {
      glm::vec3 sum(0.0f);
      for (int j = 0; j < samplesPerAxis; ++j) {
        const std::size_t row = static_cast<std::size_t>(firstRow + j) * samples.width();
        for (int i = 0; i < samplesPerAxis; ++i) sum += glm::vec3(values[row + x * samplesPerAxis + i]);
      }
      picture.pixels[static_cast<std::size_t>(tile.y + y) * picture.width + tile.x + x] = sum * weight;
    }
  }
}

}  // namespace prelight::viewer
