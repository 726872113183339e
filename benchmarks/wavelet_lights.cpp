#include "benchmarks/wavelet_lights.h"

#include <array>
#include <cmath>
#include <numbers>

#include "basis/cube_light.h"
#include "basis/cube_overlap.h"

namespace prelight::benchmarks {

namespace {

CubeMap smoothSky(int faceSize) {
  CubeMap map = darkCube(faceSize);
  for (std::uint32_t i = 0; i < map.radiance.size(); ++i) {
    const auto up = static_cast<float>(cubeTexelDirection(i, faceSize).y);
    map.radiance[i] = glm::vec3(0.4f + 0.3f * up, 0.5f + 0.4f * up, 0.7f + 0.3f * up);
  }
  return map;
}

CubeMap sunnySky(int faceSize) {
  CubeMap map = smoothSky(faceSize);
  const double halfAngle = 1.5 * std::numbers::pi / 180.0;
  addDisk(map, glm::normalize(glm::dvec3(0.5, 0.7, 0.3)), halfAngle, glm::vec3(1500.0f, 1400.0f, 1200.0f));
  return map;
}

CubeMap windows(int faceSize) {
  CubeMap map = darkCube(faceSize);
  for (glm::vec3& texel : map.radiance) texel = glm::vec3(0.05f);
  const CubeTexels texels(faceSize);
  for (int window = 0; window < 4; ++window) {
    const double azimuth = 0.4 + 1.5 * window, low = 0.2 + 0.1 * window;
    const auto corner = [&](double turn, double height) {
      return glm::dvec3(std::sin(azimuth + turn), height, -std::cos(azimuth + turn));
    };
    const std::array<glm::dvec3, 4> corners = {corner(-0.15, low), corner(0.15, low), corner(0.15, low + 0.5),
                                               corner(-0.15, low + 0.5)};
    std::vector<TexelOverlap> overlaps;
    overlapTexels(corners, faceSize, overlaps);
    const glm::vec3 radiance(8.0f, 7.0f + 0.5f * static_cast<float>(window),
                             10.0f - static_cast<float>(window));
    for (const TexelOverlap& overlap : overlaps) {
      map.radiance[overlap.texel] +=
          static_cast<float>(overlap.solidAngle / texels.solidAngle(overlap.texel)) * radiance;
    }
  }
  return map;
}

}  // namespace

std::vector<NamedLight> waveletLights(int faceSize, const std::vector<std::filesystem::path>& skies) {
  std::vector<NamedLight> lights = {
      {"smooth", smoothSky(faceSize)}, {"sun", sunnySky(faceSize)}, {"windows", windows(faceSize)}};
  for (const std::filesystem::path& sky : skies) {
    lights.push_back({sky.stem().string(), cubeFromEnvironment(readEnvironment(sky), faceSize)});
  }
  return lights;
}

}  // namespace prelight::benchmarks
