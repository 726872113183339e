#include <memory>

#include "prelight/bake.h"
#include "techniques/ambient_occlusion/ambient_occlusion.h"
#include "techniques/occlusion_cones/occlusion_cones.h"
#include "viewer/programs/drawn_shading.h"
#include "viewer/programs/drawn_transfer.h"
#include "viewer/techniques/through/through_lighting.h"

namespace prelight::viewer {
namespace {

/// Ambient occlusion, bent normals and their cones as vertex attributes.
class AoAttributes : public DrawnTransfer {
 public:
  explicit AoAttributes(const Bake& bake)
      : accessibility_(Attribute::Accessibility, std::span<const float>(bake.ao)),
        bentNormals_(Attribute::BentNormal, std::span<const glm::vec4>(cones(bake))) {}

  void light(const Illumination&) override {}
  void bind(const gl::Program&) const override {
    accessibility_.attach();
    bentNormals_.attach();
  }
  void describe(const Illumination&, Warnings&) const override {}

 private:
  /// [vertex], bent normal and aperture; 0 where the bake has none.
  static std::vector<glm::vec4> cones(const Bake& bake) {
    std::vector<glm::vec4> cones;
    for (std::size_t v = 0; v < bake.bentNormals.size(); ++v)
      cones.emplace_back(bake.bentNormals[v], bake.apertures.empty() ? 0.0f : bake.apertures[v]);
    return cones;
  }

  VertexStream accessibility_;
  VertexStream bentNormals_;
};

/// The accessibility of surfaces' other sides, as a vertex attribute.
class ThroughAo : public DrawnTransfer {
 public:
  explicit ThroughAo(std::span<const float> open)
      : open_(Attribute::Through,
              std::span<const glm::vec3>(std::vector<glm::vec3>(open.begin(), open.end()))) {}

  void light(const Illumination&) override {}
  void bind(const gl::Program&) const override { open_.attach(); }
  void describe(const Illumination&, Warnings&) const override {}

 private:
  VertexStream open_;
};

std::unique_ptr<DrawnTransfer> makeAo(const TechniqueInputs& of) {
  std::unique_ptr<DrawnTransfer> fronts = std::make_unique<AoAttributes>(*of.inputs.bake);
  const auto& through = of.inputs.bake->through;
  if (!through || through->ao.empty()) return fronts;
  return std::make_unique<ThroughLighting>(std::move(fronts), std::make_unique<ThroughAo>(through->ao));
}

std::unique_ptr<DrawnTransfer> makeCones(const TechniqueInputs& of) {
  return std::make_unique<AoAttributes>(*of.inputs.bake);
}

}  // namespace

extern const DrawnShading drawnAo = {.info = &aoShading, .make = makeAo};
extern const DrawnShading drawnCones = {.info = &conesShading, .make = makeCones};

}  // namespace prelight::viewer
