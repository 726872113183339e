#include "viewer/horizon_lighting.h"

#include <array>

#include "base/parallel.h"
#include "basis/sh_windows.h"
#include "transfer/horizons.h"
#include "transfer/surface_frame.h"

namespace prelight::viewer {
namespace {

constexpr int horizonSkyOrder = 3;  // bands of the sky, as around the normals of other shadings

std::span<const float> rowOf(const HorizonTransfer& horizons, std::size_t vertex) {
  const auto sectors = static_cast<std::size_t>(horizons.sectors);
  return std::span(horizons.angles).subspan(vertex * sectors, sectors);
}

using SkyBands = std::array<glm::dvec3, horizonSkyOrder * horizonSkyOrder>;

/// A sky as it is, and smoothed until it is negative nowhere: three bands ring, which open places do not see
/// but those with little of it do.
struct SmoothedSky {
  SkyBands sharp{}, smooth{};

  explicit SmoothedSky(const Illumination& light) {
    const std::vector<glm::dvec3> bands = light.sky->turned(light.skyRotation, horizonSkyOrder);
    std::vector<double> channels;
    for (int channel = 0; channel < 3; ++channel)
      for (const glm::dvec3& band : bands) channels.push_back(band[channel]);
    const std::vector<double> factors = sh::minimalWindow(channels, horizonSkyOrder).factors;
    for (int l = 0; l < horizonSkyOrder; ++l)
      for (auto i = static_cast<std::size_t>(l * l); i < static_cast<std::size_t>((l + 1) * (l + 1)); ++i) {
        sharp[i] = bands[i];
        smooth[i] = factors[static_cast<std::size_t>(l)] * bands[i];
      }
  }

  SkyBands seenFrom(double accessibility) const {
    const double share = accessibility * (2.0 - accessibility);
    SkyBands bands;
    for (std::size_t i = 0; i < bands.size(); ++i) bands[i] = glm::mix(smooth[i], sharp[i], share);
    return bands;
  }
};

std::vector<float> accessibilities(const HorizonTransfer& horizons, std::size_t vertices) {
  std::vector<float> open(vertices);
  for (std::size_t v = 0; v < vertices; ++v)
    open[v] = static_cast<float>(accessibilityOf(rowOf(horizons, v)));
  return open;
}

}  // namespace

HorizonLighting::HorizonLighting(const HorizonTransfer& horizons, const CompiledScene& scene)
    : scene_(scene),
      horizons_(horizons),
      angles_(gl::makeBufferTexture(std::span<const float>(horizons.angles), 1, GL_R32F, "horizons")),
      accessibility_(Attribute::Accessibility,
                     std::span<const float>(accessibilities(horizons, scene.vertexCount()))),
      sky_(Attribute::Radiance, std::span<const glm::vec3>(std::vector<glm::vec3>(scene.vertexCount()))) {}

void HorizonLighting::light(const Illumination& light) {
  softness_ = static_cast<float>(light.horizonSoftness);
  const SmoothedSky smoothed(light);
  std::vector<glm::vec3> sky(scene_.vertexCount());
  parallelRanges(sky.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::span<const float> horizons = rowOf(horizons_, v);
      sky[v] = glm::vec3(skyAboveHorizons(smoothed.seenFrom(accessibilityOf(horizons)),
                                          glm::dmat3(surfaceFrame(scene_.normals[v])), horizons));
    }
  });
  sky_.fill(std::span<const glm::vec3>(sky));
}

void HorizonLighting::bind(const gl::Program& program) const {
  accessibility_.attach();
  sky_.attach();
  gl::bind(horizonsUnit, GL_TEXTURE_BUFFER, angles_.texture);
  program.set("horizonSectors", horizons_.sectors);
  program.set("horizonSoftness", softness_);
}

}  // namespace prelight::viewer
