#include "integrators/reference_plan.h"

namespace prelight::reference {

std::vector<PlannedPass> explainFeatures(const ShadeFeatures& f, const ReferenceRequest& request) {
  const auto pass = [](Pass name, bool runs, const char* why, const char* whyNot) {
    return PlannedPass{name, runs, runs ? why : whyNot};
  };
  const bool deep = request.depth > 1;
  return {pass(Pass::DirectLight, deep && f.scatters && (f.punctual || f.emitters || f.sky),
               "lights are sampled at every vertex",
               !deep        ? "paths of one segment show only lights"
               : f.scatters ? "nothing gives light"
                            : "no surface scatters light"),
          pass(Pass::FurtherVertices, request.depth > 2 && f.scatters,
               "paths go on until they have as many segments as they may",
               f.scatters ? "paths may have no more than two segments" : "no surface scatters light"),
          pass(Pass::VirtualLights, request.integrator == Integrator::Instant && request.depth > 2,
               "they represent diffuse bounces", "paths go on instead"),
          pass(Pass::PunctualLights, f.punctual, "there are some", "there are none"),
          pass(Pass::Emitters, f.emitters, "some triangles emit", "no triangle emits"),
          pass(Pass::Sky, f.sky, "it gives light", "there is none, or it is black"),
          pass(Pass::Mirrors, f.mirror, "some surface reflects without roughness",
               "no surface reflects without roughness"),
          pass(Pass::GlossyLobes, f.glossy, "some surface reflects with roughness",
               "no surface reflects with roughness"),
          pass(Pass::Glass, f.glass, "some material transmits", "no material transmits"),
          pass(Pass::LightThroughSurfaces, f.translucent, "some material transmits light diffusely",
               "no material transmits light diffusely"),
          pass(Pass::Absorption, f.absorption, "some solid glass attenuates", "no solid glass attenuates"),
          pass(Pass::Textures, f.textures, "some material has one", "no material has one")};
}

BuildOptions buildOptions(const ReferenceRequest& request, std::optional<bool> cachedLight,
                          BuildOptions options) {
  const bool whitted = request.integrator == Integrator::Whitted;
  if (cachedLight)
    options.define("PRELIGHT_DIFFUSE_BOUNCES", *cachedLight ? 1 : 0);
  else if (request.integrator != Integrator::Path)
    options.define("PRELIGHT_DIFFUSE_BOUNCES", request.integrator == Integrator::Distributed ? 1 : 0);
  if (request.leastDepth > 1) options.define("PRELIGHT_LEAST_DEPTH", request.leastDepth);
  return options.defineIf(whitted, "PRELIGHT_NO_GLOSSY_BOUNCES")
      .defineIf(whitted || request.estimator == Estimator::LightsOnly, "PRELIGHT_LIGHTS_ONLY")
      .defineIf(!whitted && request.estimator == Estimator::ScatterOnly, "PRELIGHT_SCATTER_ONLY");
}

}  // namespace prelight::reference
