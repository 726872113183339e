#include <memory>

#include "prelight/bake.h"
#include "viewer/programs/technique_pass.h"
#include "viewer/scene/vertex_stream.h"

namespace prelight::viewer {
namespace {

/// The sky that vertices see by a bake's ambient occlusion, for reflections in shadings that know no more of
/// it than the light that arrives, interreflected light included.
class OpenSkyPass final : public TechniquePass {
 public:
  explicit OpenSkyPass(const RenderInputs& inputs)
      : inputs_(inputs),
        accessibility_(Attribute::Accessibility, std::span<const float>()),
        bentNormals_(Attribute::BentNormal, std::span<const glm::vec4>()) {}

  void prepare(const PictureState&, SceneDrawer&) override {
    const Bake& bake = *inputs_.bake;
    if (shown_ == bake.ao.data()) return;
    std::vector<glm::vec4> bent;
    for (const glm::vec3& n : bake.bentNormals) bent.emplace_back(n, 0.0f);
    accessibility_.fill(std::span<const float>(bake.ao));
    bentNormals_.fill(std::span<const glm::vec4>(bent));
    shown_ = bake.ao.data();
  }

  void bind(const gl::Program&) const override {
    if (shown_ == nullptr) return;
    accessibility_.attach();
    bentNormals_.attach();
  }

 private:
  const RenderInputs& inputs_;
  const float* shown_ = nullptr;  ///< values that the streams hold
  VertexStream accessibility_;
  VertexStream bentNormals_;
};

bool takesOpenSky(Shading shading, const RenderInputs& inputs) {
  if (inputs.bake == nullptr || inputs.bake->ao.empty() || inputs.bake->bentNormals.empty()) return false;
  return rulesOf(shading, inputs).ambient.knowsLightAlone;
}

}  // namespace

extern const PassRow openSkyRow = {
    .isIn = takesOpenSky,
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<TechniquePass> {
      return std::make_unique<OpenSkyPass>(of.inputs);
    },
};

}  // namespace prelight::viewer
