#include <vector>

#include "base/parallel.h"
#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"
#include "relight/sky_ringing.h"
#include "scene/surface/surface_frame.h"
#include "techniques/horizons/horizon_bands.h"
#include "techniques/horizons/horizons.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/drawn_shading.h"
#include "viewer/programs/drawn_transfer.h"

namespace prelight::viewer {
namespace {

/// The sky and lights above the horizons of vertices (host/techniques/horizons/horizon_bands.h): the sky is
/// lit a vertex, whenever it changes, lights in the fragment shader.
class HorizonLighting : public DrawnTransfer {
 public:
  /// The scene outlives it.
  HorizonLighting(const HorizonTransfer& horizons, const CompiledScene& scene);

  void light(const Illumination& light) override;
  bool verticesMoved() override { return true; }
  void bind(const gl::Program& program) const override;
  void describe(const Illumination&, Warnings&) const override {}

 private:
  const CompiledScene& scene_;
  HorizonTransfer horizons_;
  gl::BufferTexture bands_;  ///< [vertex][sector]
  VertexStream accessibility_;
  VertexStream sky_;  ///< before the albedo
  float softness_ = 0.0f;
};

constexpr int horizonSkyOrder = 3;  // bands of the sky, as around the normals of other shadings

/// Angles of a vertex; of feet that there are none of: none.
std::span<const float> rowOf(const HorizonTransfer& horizons, const std::vector<float>& angles,
                             std::size_t vertex) {
  const auto sectors = static_cast<std::size_t>(horizons.sectors);
  if (angles.empty()) return {};
  return std::span(angles).subspan(vertex * sectors, sectors);
}

double accessibilityAt(const HorizonTransfer& horizons, std::size_t vertex) {
  return accessibilityOf(rowOf(horizons, horizons.feet, vertex), rowOf(horizons, horizons.angles, vertex));
}

/// [vertex][sector] foot and horizon.
std::vector<glm::vec2> bandsOf(const HorizonTransfer& horizons) {
  std::vector<glm::vec2> bands;
  for (std::size_t i = 0; i < horizons.angles.size(); ++i)
    bands.emplace_back(horizons.feet.empty() ? 0.0f : horizons.feet[i], horizons.angles[i]);
  return bands;
}

/// A sky as it is, and smoothed until it is negative nowhere: three bands ring, which open places do not see
/// but those with little of it do.
struct SmoothedSky {
  std::vector<glm::dvec3> sharp, smooth;

  explicit SmoothedSky(const Illumination& light)
      : sharp(skyCoefficients(light, horizonSkyOrder)),
        smooth(smoothedCoefficients(light, horizonSkyOrder)) {}
};

/// Irradiance over pi of a vertex.
glm::vec3 skyAt(const CompiledScene& scene, const HorizonTransfer& horizons, const SmoothedSky& sky,
                std::size_t vertex) {
  const glm::dmat3 frame(surfaceFrame(scene.normals[vertex]));
  const auto feet = rowOf(horizons, horizons.feet, vertex), angles = rowOf(horizons, horizons.angles, vertex);
  const glm::dvec3 sharp = skyAboveHorizons(sky.sharp, frame, feet, angles),
                   smooth = skyAboveHorizons(sky.smooth, frame, feet, angles);
  glm::vec3 light;
  for (int c = 0; c < 3; ++c) light[c] = static_cast<float>(withoutRinging(sharp[c], smooth[c]));
  return light;
}

std::vector<float> accessibilities(const HorizonTransfer& horizons, std::size_t vertices) {
  std::vector<float> open(vertices);
  for (std::size_t v = 0; v < vertices; ++v) open[v] = static_cast<float>(accessibilityAt(horizons, v));
  return open;
}

}  // namespace

HorizonLighting::HorizonLighting(const HorizonTransfer& horizons, const CompiledScene& scene)
    : scene_(scene),
      horizons_(horizons),
      bands_(gl::makeBufferTexture(std::span<const glm::vec2>(bandsOf(horizons)), 1, GL_RG32F, "horizons")),
      accessibility_(Attribute::Accessibility,
                     std::span<const float>(accessibilities(horizons, scene.vertexCount()))),
      sky_(Attribute::Radiance, std::span<const glm::vec3>(std::vector<glm::vec3>(scene.vertexCount()))) {}

void HorizonLighting::light(const Illumination& light) {
  softness_ = static_cast<float>(light.horizonSoftness);
  const SmoothedSky smoothed(light);
  std::vector<glm::vec3> sky(scene_.vertexCount());
  parallelRanges(sky.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) sky[v] = skyAt(scene_, horizons_, smoothed, v);
  });
  sky_.fill(std::span<const glm::vec3>(sky));
}

void HorizonLighting::bind(const gl::Program& program) const {
  accessibility_.attach();
  sky_.attach();
  gl::bind(horizonsUnit, GL_TEXTURE_BUFFER, bands_.texture);
  program.set("horizonSectors", horizons_.sectors);
  program.set("horizonSoftness", softness_);
}

extern const DrawnShading drawnHorizons = {
    .info = &horizonsShading,
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<DrawnTransfer> {
      return std::make_unique<HorizonLighting>(*of.inputs.bake->horizons, of.inputs.compiled);
    },
};

}  // namespace prelight::viewer
