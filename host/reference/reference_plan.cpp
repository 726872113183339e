#include "reference/reference_plan.h"

namespace prelight::reference {

std::vector<PlannedPass> explainFeatures(const ShadeFeatures& f, const ReferenceRequest& request) {
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
          pass("virtual lights", request.integrator == Integrator::Instant && request.depth > 2,
               "they stand for diffuse bounces", "paths go on instead"),
          pass("punctual lights", f.punctual, "the scene or --light has some", "there are none"),
          pass("emitters", f.emitters, "some triangles emit", "no triangle emits"),
          pass("sky", f.sky, "--env gives light", "no --env, or it is black"),
          pass("mirrors", f.mirror, "some surface reflects without roughness",
               "no surface reflects without roughness"),
          pass("glossy lobes", f.glossy, "some surface reflects with roughness",
               "no surface reflects with roughness"),
          pass("glass", f.glass, "some material transmits", "no material transmits"),
          pass("light through surfaces", f.translucent, "some material transmits light diffusely",
               "no material transmits light diffusely"),
          pass("absorption", f.absorption, "some solid glass attenuates", "no solid glass attenuates"),
          pass("textures", f.layerTextures, "some material has one", "no material has one")};
}

BuildOptions buildOptions(const ReferenceRequest& request, std::optional<bool> cachedLight,
                          BuildOptions options) {
  const bool whitted = request.integrator == Integrator::Whitted;
  if (cachedLight)
    options.define("PRELIGHT_DIFFUSE_BOUNCES", *cachedLight ? 1 : 0);
  else if (request.integrator != Integrator::Path)
    options.define("PRELIGHT_DIFFUSE_BOUNCES", request.integrator == Integrator::Distributed ? 1 : 0);
  return options.defineIf(whitted, "PRELIGHT_NO_GLOSSY_BOUNCES")
      .defineIf(whitted || request.estimator == Estimator::LightsOnly, "PRELIGHT_LIGHTS_ONLY")
      .defineIf(!whitted && request.estimator == Estimator::ScatterOnly, "PRELIGHT_SCATTER_ONLY");
}

}  // namespace prelight::reference
