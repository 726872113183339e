#include "export/texel_codes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "export/map_picture.h"
#include "receivers/surface_sampler.h"

namespace prelight {

std::uint8_t toByte(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(255.0 * value), 0L, 255L));
}

namespace {

using Texel = std::array<std::uint8_t, 4>;

constexpr double rgbmRange = 8.0, rgbdGamma = 2.2;
/// Largest 1 / alpha that RGBD is used with, of the possible 255: this leaves dark texels more steps.
constexpr double rgbdRange = 64.0;

double largestOf(const glm::dvec3& value) { return std::max({value.x, value.y, value.z}); }

/// Round alpha to a multiple of 1/255, in the direction that keeps colours within 0..1.
double stepsUp(double alpha) { return std::clamp(std::ceil(255.0 * alpha), 1.0, 255.0) / 255.0; }
double stepsDown(double alpha) { return std::clamp(std::floor(255.0 * alpha), 1.0, 255.0) / 255.0; }

/// Returns an evenly dithered texel: offsets from the R2 sequence (Roberts 2018), which is spread evenly over
/// the picture, choose between the neighbouring steps of a value, so that even values below one step are
/// right on average.
Texel scaledTexel(const glm::dvec3& value, int x, int y) {
  const double whole = 0.7548776662466927 * x + 0.5698402909980532 * y;
  const double step = (whole - std::floor(whole) - 0.5) / 255.0;
  return {toByte(value.x + step), toByte(value.y + step), toByte(value.z + step), 255};
}

Texel rgbmTexel(const glm::dvec3& value) {
  const glm::dvec3 root = glm::sqrt(value) / rgbmRange;
  const double alpha = stepsUp(largestOf(root));
  return {toByte(root.x / alpha), toByte(root.y / alpha), toByte(root.z / alpha), toByte(alpha)};
}

Texel rgbdTexel(const glm::dvec3& value) {
  const double alpha = stepsDown(1.0 / std::max(1.0, largestOf(value)));
  const glm::dvec3 root = glm::pow(value * alpha, glm::dvec3(1.0 / rgbdGamma));
  return {toByte(root.x), toByte(root.y), toByte(root.z), toByte(alpha)};
}

/// Returns the largest value that a code holds at scale 1.
double rangeOf(TexelCode code) {
  switch (code) {
    case TexelCode::Rgbm:
      return rgbmRange * rgbmRange;
    case TexelCode::Rgbd:
      return rgbdRange;
    case TexelCode::Scaled:
      break;
  }
  return 1.0;
}

Texel encode(const glm::dvec3& value, TexelCode code, int x, int y) {
  switch (code) {
    case TexelCode::Rgbm:
      return rgbmTexel(value);
    case TexelCode::Rgbd:
      return rgbdTexel(value);
    case TexelCode::Scaled:
      break;
  }
  return scaledTexel(value, x, y);
}

}  // namespace

CodedPicture encodeTexels(const Picture& picture, TexelCode code) {
  double largest = 0.0;
  for (const glm::vec3& pixel : picture.pixels) largest = std::max(largest, largestOf(pixel));
  return encodeTexels(picture, code, largest > 0.0 ? static_cast<float>(largest / rangeOf(code)) : 1.0f);
}

CodedPicture encodeTexels(const Picture& picture, TexelCode code, float scale) {
  CodedPicture coded{{"light map", picture.width, picture.height, {}}, scale};
  coded.image.rgba.reserve(4 * picture.pixels.size());
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const auto width = static_cast<std::size_t>(picture.width);
    const Texel texel = encode(glm::dvec3(picture.pixels[i]) / static_cast<double>(scale), code,
                               static_cast<int>(i % width), static_cast<int>(i / width));
    coded.image.rgba.insert(coded.image.rgba.end(), texel.begin(), texel.end());
  }
  return coded;
}

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
