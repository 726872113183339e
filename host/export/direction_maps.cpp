#include "export/direction_maps.h"

#include <algorithm>
#include <numbers>

#include "export/map_picture.h"
#include "export/texel_codes.h"
#include "receivers/texel_receiver.h"

namespace prelight {

namespace {

/// Returns a coefficient of the map in every texel. Texels without a place on the surface are not filled.
Picture coefficientPicture(const LightMap& map, std::size_t coefficient) {
  const auto length = static_cast<std::size_t>(map.coefficients);
  Picture picture{map.layout.width, map.layout.height, {}};
  for (std::size_t texel = 0; texel < map.layout.texelCount(); ++texel) {
    const float* values = &map.values[3 * length * texel + coefficient];
    picture.pixels.emplace_back(values[0], values[length], values[2 * length]);
  }
  return picture;
}

double luminance(const glm::vec3& color) {
  return glm::dot(glm::dvec3(color), glm::dvec3(0.2126, 0.7152, 0.0722));
}

}  // namespace

std::vector<Picture> radianceMaps(const LightMap& map) {
  const std::vector<bool> met = metTexels(map.layout);
  std::vector<Picture> pictures;
  for (std::size_t i = 0; i < radianceMapNames.size(); ++i) {
    pictures.push_back(coefficientPicture(map, i + 1));
    fillEmptyTexels(pictures.back(), met);
  }
  return pictures;
}

Image directionImage(const CompiledScene& scene, const LightMap& map) {
  const std::vector<Picture> radiance = radianceMaps(map);
  Picture normals{map.layout.width, map.layout.height,
                  std::vector<glm::vec3>(map.layout.texelCount(), glm::vec3(0.0f))};
  for (const LightMapTexel& texel : map.layout.texels) {
    const device::Receiver receiver = receiverAt(scene, texel);
    normals.pixels[texel.texel] = {receiver.normal[0], receiver.normal[1], receiver.normal[2]};
  }
  fillEmptyTexels(normals, metTexels(map.layout));
  Image image{"light map directions", map.layout.width, map.layout.height, {}};
  for (std::size_t texel = 0; texel < map.layout.texelCount(); ++texel) {
    const auto of = [&](std::size_t i) { return luminance(radiance[i].pixels[texel]); };
    // Bands 0 and 1 are the integrals of radiance divided by sqrt(4 pi), and of radiance times direction
    // divided by sqrt(4 pi / 3).
    const double whole = of(0);
    glm::dvec3 direction(0.0);
    if (whole > 0.0) direction = glm::dvec3(of(3), of(1), of(2)) / (std::numbers::sqrt3 * whole);
    direction /= std::max(1.0, glm::length(direction));
    const glm::dvec3 normal(normals.pixels[texel]);
    for (int a = 0; a < 3; ++a) image.rgba.push_back(toByte(0.5 * direction[a] + 0.5));
    image.rgba.push_back(toByte(0.5 * glm::dot(normal, direction) + 0.5));
  }
  return image;
}

}  // namespace prelight
