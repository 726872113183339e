#include "reference/reference_plan.h"

#include <algorithm>

namespace prelight::reference {

namespace {

/// As PRELIGHT_SMOOTH_BELOW in kernels/reference/bsdf_funcs.cl.
constexpr float smoothBelow = 0.05f;

bool reflectsSpecularly(const CompiledMaterial& m) {
  return !m.unlit && (m.metallic > 0.0f || (m.specular > 0.0f && m.transmission < 1.0f));
}

bool isGlass(const CompiledMaterial& m) { return !m.unlit && m.transmission > 0.0f && m.metallic < 1.0f; }

/// With a texture of roughness a surface may be either.
bool mayBeSmooth(const CompiledMaterial& m) {
  return m.roughness < smoothBelow || m.surfaceTexture.image >= 0;
}

}  // namespace

Features findFeatures(const ReferenceInputs& inputs, const LightTables& lights) {
  Features f;
  f.punctual = !lights.punctual.empty();
  f.emitters = !lights.emitters.empty();
  f.sky = !lights.sky.empty();
  std::vector<bool> used(inputs.scene.materials.size(), false);
  for (const std::uint32_t material : inputs.scene.triangleMaterials) used[material] = true;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const CompiledMaterial& m = inputs.scene.materials[i];
    if (!used[i]) continue;
    const bool specular = reflectsSpecularly(m);
    f.glass = f.glass || isGlass(m);
    f.mirror = f.mirror || (specular && mayBeSmooth(m));
    f.glossy = f.glossy || (specular && m.roughness >= smoothBelow);
    f.absorption = f.absorption || (isGlass(m) && m.solid && m.absorption != glm::vec3(0.0f));
    f.layerTextures = f.layerTextures || m.baseColorTexture.image >= 0 || m.surfaceTexture.image >= 0 ||
                      m.emissionTexture.image >= 0;
    f.scatters = f.scatters || (!m.unlit && (m.baseColor != glm::vec3(0.0f) || specular || isGlass(m)));
  }
  return f;
}

std::vector<PlannedPass> explainFeatures(const Features& f, const ReferenceRequest& request) {
  const auto pass = [](const char* name, bool runs, const char* why, const char* whyNot) {
    return PlannedPass{name, runs, runs ? why : whyNot};
  };
  const bool deep = request.depth > 1;
  return {pass("direct light", deep && f.scatters && (f.punctual || f.emitters || f.sky),
               "lights are sampled at every vertex",
               !deep        ? "--depth 1 shows lights alone"
               : f.scatters ? "nothing gives light"
                            : "no surface scatters light"),
          pass("further vertices", request.depth > 2 && f.scatters, "paths go on up to --depth",
               f.scatters ? "--depth ends paths before" : "no surface scatters light"),
          pass("punctual lights", f.punctual, "the scene or --light has some", "there are none"),
          pass("emitters", f.emitters, "some triangles emit", "no triangle emits"),
          pass("sky", f.sky, "--env gives light", "no --env, or it is black"),
          pass("mirrors", f.mirror, "some surface reflects without roughness",
               "no surface reflects without roughness"),
          pass("glossy lobes", f.glossy, "some surface reflects with roughness",
               "no surface reflects with roughness"),
          pass("glass", f.glass, "some material transmits", "no material transmits"),
          pass("absorption", f.absorption, "some solid glass attenuates", "no solid glass attenuates"),
          pass("textures", f.layerTextures, "some material has one", "no material has one")};
}

BuildOptions buildOptions(const Features& f, const ReferenceRequest& request, BuildOptions options) {
  const bool whitted = request.integrator == Integrator::Whitted;
  if (whitted || request.integrator == Integrator::Distributed)
    options.define("PRELIGHT_DIFFUSE_BOUNCES", whitted ? 0 : 1);
  return options.defineIf(f.punctual, "PRELIGHT_PUNCTUAL")
      .defineIf(f.emitters, "PRELIGHT_EMITTERS")
      .defineIf(f.sky, "PRELIGHT_SKY")
      .defineIf(f.glass, "PRELIGHT_GLASS")
      .defineIf(f.mirror, "PRELIGHT_MIRROR")
      .defineIf(f.glossy, "PRELIGHT_GLOSSY")
      .defineIf(f.absorption, "PRELIGHT_ABSORPTION")
      .defineIf(f.layerTextures, "PRELIGHT_LAYER_TEXTURES")
      .defineIf(whitted, "PRELIGHT_NO_GLOSSY_BOUNCES")
      .defineIf(whitted || request.estimator == Estimator::LightsOnly, "PRELIGHT_LIGHTS_ONLY")
      .defineIf(!whitted && request.estimator == Estimator::ScatterOnly, "PRELIGHT_SCATTER_ONLY");
}

}  // namespace prelight::reference
