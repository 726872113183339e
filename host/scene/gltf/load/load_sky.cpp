#include "scene/gltf/load/load_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "base/magnitudes.h"
#include "scene/gltf/image_decode.h"
#include "scene/gltf/json_cursor.h"
#include "scene/gltf/load/load_parts.h"

namespace prelight {

namespace {

constexpr int widestSky = 4096;
constexpr int harmonicSky = 128;  // texels per row; bands 0 to 2 are smooth

struct CubeFace {
  int size = 0;
  std::vector<glm::vec3> radiance;  ///< [row][column], row 0 at the top
};
using SkyCube = std::array<CubeFace, 6>;  ///< +X, -X, +Y, -Y, +Z, -Z

/// The point where a direction meets the cube: the face and, from 0 to 1, the position to the right and down.
struct CubePlace {
  std::size_t face = 0;
  glm::dvec2 uv{0.5};
};

/// Returns the place of a direction as in chapter 8.13 of OpenGL's specification.
CubePlace placeOnCube(const glm::dvec3& d) {
  const glm::dvec3 a = glm::abs(d);
  const auto place = [](std::size_t face, double s, double t, double major) {
    return CubePlace{face, {0.5 * (s / major + 1.0), 0.5 * (t / major + 1.0)}};
  };
  if (a.x >= a.y && a.x >= a.z) return d.x > 0.0 ? place(0, -d.z, -d.y, a.x) : place(1, d.z, -d.y, a.x);
  if (a.y >= a.z) return d.y > 0.0 ? place(2, d.x, d.z, a.y) : place(3, d.x, -d.z, a.y);
  return d.z > 0.0 ? place(4, d.x, -d.y, a.z) : place(5, -d.x, -d.y, a.z);
}

glm::dvec3 sampleFace(const CubeFace& face, const glm::dvec2& uv) {
  const glm::dvec2 at = uv * double(face.size) - 0.5;
  const auto texel = [&](double x, double y) {
    const auto clamped = [&](double i) {
      return static_cast<std::size_t>(std::clamp(i, 0.0, face.size - 1.0));
    };
    return glm::dvec3(face.radiance[clamped(y) * static_cast<std::size_t>(face.size) + clamped(x)]);
  };
  const glm::dvec2 low = glm::floor(at), part = at - low;
  return glm::mix(glm::mix(texel(low.x, low.y), texel(low.x + 1, low.y), part.x),
                  glm::mix(texel(low.x, low.y + 1), texel(low.x + 1, low.y + 1), part.x), part.y);
}

/// Returns the radiance of a texel: colours are divided by alpha (RGBD), which is 1 where there is none. The
/// power is that with which Babylon.js, whose authors wrote the extension, decodes colours.
glm::vec3 radianceOf(const std::uint8_t* rgba) {
  constexpr double gamma = 2.2;
  glm::vec3 radiance;
  for (int c = 0; c < 3; ++c) radiance[c] = static_cast<float>(std::pow(rgba[c] / 255.0, gamma));
  return radiance * (255.0f / static_cast<float>(std::max<int>(rgba[3], 1)));
}

class SkyLoader {
 public:
  SkyLoader(const GltfDocument& document, const JsonCursor& root, const JsonCursor& light, Warnings& warnings)
      : document_(document), root_(root), light_(light), warnings_(warnings) {
    intensity_ = light.numberOr("intensity", 1.0);
    if (!(intensity_ >= 0.0 && intensity_ <= largestInput))
      light.at("intensity").fail(fmt::format("expected 0 to {:g}, got {}", largestInput, intensity_));
    if (const auto rotation = light.find("rotation")) {
      rotation->expectNumbers(4);
      const auto number = [&](std::size_t i) { return rotation->at(i).asNumber(); };
      const glm::dquat turn(number(3), number(0), number(1), number(2));
      const double length = glm::length(turn);
      if (length > 0.0 && std::isfinite(length)) turn_ = glm::mat3_cast(turn / length);
    }
  }

  Environment load() {
    const std::array<std::array<double, 3>, 9> irradiance = readCoefficients();
    if (const auto cube = readCube())
      return make(std::min(4 * (*cube)[0].size, widestSky), [&](const glm::dvec3& d) {
        const CubePlace place = placeOnCube(d);
        return sampleFace((*cube)[place.face], place.uv);
      });
    warnings_.push_back(fmt::format(
        "{}: its pictures cannot be used; the sky comes from its irradiance coefficients", light_.where()));
    return make(harmonicSky, [&](const glm::dvec3& d) { return harmonicRadiance(irradiance, d); });
  }

 private:
  /// Builds the sky from a cube oriented as in OpenGL, whose face +Z lies along the scene's -Z.
  template <class Radiance>
  Environment make(int width, Radiance radiance) const {
    Environment sky{width, width / 2, {}};
    sky.radiance.reserve(std::size_t(sky.width) * std::size_t(sky.height));
    const glm::dmat3 back = glm::transpose(turn_);
    for (int y = 0; y < sky.height; ++y)
      for (int x = 0; x < sky.width; ++x) {
        const glm::dvec3 world = Environment::direction((x + 0.5) / sky.width, (y + 0.5) / sky.height);
        const glm::dvec3 d = back * world;
        const glm::dvec3 value = intensity_ * radiance(glm::dvec3(d.x, d.y, -d.z));
        sky.radiance.emplace_back(glm::clamp(value, 0.0, largestInput));
      }
    return sky;
  }

  static double coefficient(const JsonCursor& json) {
    const double number = json.asNumber();
    if (std::abs(number) > largestInput)
      json.fail(fmt::format("{:g}, expected at most {:g} in size", number, largestInput));
    return number;
  }

  std::array<std::array<double, 3>, 9> readCoefficients() const {
    const JsonCursor json = light_.at("irradianceCoefficients");
    if (json.arraySize() != 9) json.fail(fmt::format("{} coefficients, expected 9", json.arraySize()));
    std::array<std::array<double, 3>, 9> coefficients{};
    for (std::size_t i = 0; i < 9; ++i) {
      json.at(i).expectNumbers(3);
      for (std::size_t c = 0; c < 3; ++c) coefficients[i][c] = coefficient(json.at(i).at(c));
    }
    return coefficients;
  }

  /// Returns radiance from irradiance coefficients: irradiance is radiance times pi, 2 pi / 3 and pi / 4 in
  /// bands 0 to 2 (Ramamoorthi and Hanrahan 2001, Eq. 9).
  static glm::dvec3 harmonicRadiance(const std::array<std::array<double, 3>, 9>& irradiance,
                                     const glm::dvec3& d) {
    constexpr double pi = std::numbers::pi;
    const std::array<double, 9> y = {0.282095 / pi,
                                     0.488603 * d.y * 1.5 / pi,
                                     0.488603 * d.z * 1.5 / pi,
                                     0.488603 * d.x * 1.5 / pi,
                                     1.092548 * d.x * d.y * 4.0 / pi,
                                     1.092548 * d.y * d.z * 4.0 / pi,
                                     0.315392 * (3.0 * d.z * d.z - 1.0) * 4.0 / pi,
                                     1.092548 * d.x * d.z * 4.0 / pi,
                                     0.546274 * (d.x * d.x - d.y * d.y) * 4.0 / pi};
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < 9; ++i)
      for (std::size_t c = 0; c < 3; ++c) sum[static_cast<int>(c)] += irradiance[i][c] * y[i];
    return sum;
  }

  /// Returns nullopt where an image is missing, broken or not square.
  std::optional<SkyCube> readCube() {
    const JsonCursor levels = light_.at("specularImages");
    if (levels.arraySize() == 0) levels.fail("expected the pictures of a cube at least, got none");
    const JsonCursor faces = levels.at(0);
    if (faces.arraySize() != 6) faces.fail(fmt::format("{} pictures, expected 6", faces.arraySize()));
    const std::size_t images = root_.countOf("images");
    std::vector<bool> used(images, false);
    for (std::size_t i = 0; i < 6; ++i) used[faces.at(i).asIndex(images, "image")] = true;
    checkImages(document_, used);
    SkyCube cube;
    for (std::size_t i = 0; i < 6; ++i) {
      const std::size_t before = warnings_.size();
      if (!root_.at("images").at(faces.at(i).asUnsigned()).find("bufferView")) return std::nullopt;
      const Image image = loadImage(document_, faces.at(i).asUnsigned(), warnings_);
      if (warnings_.size() != before || image.width != image.height) return std::nullopt;
      cube[i].size = image.width;
      // Rows of images run upwards, as in Babylon.js.
      const auto size = static_cast<std::size_t>(image.width);
      for (std::size_t row = size; row-- > 0;)
        for (std::size_t x = 0; x < size; ++x)
          cube[i].radiance.push_back(radianceOf(&image.rgba[4 * (row * size + x)]));
    }
    return cube;
  }

  const GltfDocument& document_;
  const JsonCursor& root_;
  const JsonCursor& light_;
  Warnings& warnings_;
  double intensity_ = 1.0;
  glm::dmat3 turn_{1.0};
};

std::optional<JsonCursor> imageBased(const JsonCursor& holder) {
  return LoadContext::extension(holder, "EXT_lights_image_based");
}

}  // namespace

std::optional<Environment> loadSky(const GltfDocument& document, Warnings& warnings) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  const auto defined = imageBased(root);
  if (!defined || root.countOf("scenes") == 0) return std::nullopt;
  const JsonCursor scene = root.at("scenes").at(root.unsignedOr("scene", 0));
  const auto chosen = imageBased(scene);
  if (!chosen) return std::nullopt;
  const JsonCursor light =
      defined->at("lights").at(chosen->at("light").asIndex(defined->countOf("lights"), "light"));
  return SkyLoader(document, root, light, warnings).load();
}

}  // namespace prelight
