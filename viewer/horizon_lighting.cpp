#include "viewer/horizon_lighting.h"

#include "base/parallel.h"
#include "transfer/horizons.h"
#include "transfer/surface_frame.h"

namespace prelight::viewer {
namespace {

constexpr int horizonSkyOrder = 3;  // bands of the sky, as around the normals of other shadings

std::span<const float> rowOf(const HorizonTransfer& horizons, std::size_t vertex) {
  const auto sectors = static_cast<std::size_t>(horizons.sectors);
  return std::span(horizons.angles).subspan(vertex * sectors, sectors);
}

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
  const std::vector<glm::dvec3> coefficients = light.sky->turned(light.skyRotation, horizonSkyOrder);
  std::vector<glm::vec3> sky(scene_.vertexCount());
  parallelRanges(sky.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      sky[v] = glm::vec3(
          skyAboveHorizons(coefficients, glm::dmat3(surfaceFrame(scene_.normals[v])), rowOf(horizons_, v)));
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
