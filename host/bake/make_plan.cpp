#include "bake/make_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "bake/drawn_hemispheres.h"
#include "bake/estimate_memory.h"
#include "gpu/surface_upload.h"
#include "plan/cast_orders.h"
#include "plan/check_request.h"
#include "plan/shadow_sets.h"
#include "plan/tree_use.h"
#include "scene/instancing.h"
#include "scene/light_sources.h"
#include "scene/lobes.h"
#include "techniques/registry/registry.h"

namespace prelight {

namespace {

PlannedPass planTranslucent(const CompiledScene& scene, bool bounces) {
  if (!scene.hasDiffuseTransmission())
    return {Pass::TranslucentSenders, false, "no material transmits light diffusely"};
  if (!bounces) return {Pass::TranslucentSenders, false, "only bounces send light through surfaces"};
  return {
      Pass::TranslucentSenders, true,
      "both sides of transmitting surfaces are cast if one is seen; a ray takes the side that it samples"};
}

PlannedPass planBounces(const CompiledScene& scene, const BakeRequest& request) {
  if (!request.carriesLight()) return {Pass::Bounces, false, "no technique that is asked for carries light"};
  if (request.bounces == 0) return {Pass::Bounces, false, "none are asked for"};
  if (!scattersDiffusely(scene))
    return {Pass::Bounces, false,
            "no surface has a diffuse albedo above 0 or lets light through, so nothing is reflected"};
  return {Pass::Bounces, true, fmt::format("{} from stored transport, without new rays", request.bounces)};
}

PlannedPass planShadowSets(const ShadowSets& sets, const BakeRequest& request) {
  if (request.shadowSets.empty())
    return {Pass::ShadowSets, false, "not asked for: everything shadows everything"};
  if (sets.empty()) return {Pass::ShadowSets, false, "every node sees every other one anyway"};
  std::uint64_t receivers = 0;
  for (const ShadowSets::Occluders& set : sets.sets) receivers += set.receivers;
  std::string text = fmt::format("{} nodes see a part of the scene; trees of", receivers);
  const std::size_t shown = std::min<std::size_t>(sets.sets.size(), 8);
  for (std::size_t s = 0; s < shown; ++s)
    text += fmt::format("{} {} triangles ({} nodes)", s > 0 ? "," : "", sets.sets[s].triangles.size(),
                        sets.sets[s].nodes);
  if (shown < sets.sets.size()) text += fmt::format(" and {} more", sets.sets.size() - shown);
  return {Pass::ShadowSets, true,
          text + fmt::format(", about {} kB in addition to the whole scene's",
                             (sets.treeTriangles() * treeBytesPerTriangle + 999) / 1000)};
}

PlannedPass planInstances(const Instancing& instancing) {
  return {Pass::Instances, instancing.used, instancing.reason};
}

PlannedPass planCast(const PlanInput& input) {
  const BakeRequest& request = input.request;
  if (!request.castsReceivers())
    return {Pass::Cast, false, "no technique that is asked for looks from receivers"};
  if (request.visibility == Visibility::Raster) return {Pass::Cast, true, drawnCastReason(input)};
  if (input.bounces) return {Pass::Cast, true, "closest hits, because bounces need to know what was hit"};
  if (request.specular) return {Pass::Cast, true, "closest hits, because rays go on from mirrors and glass"};
  for (const Technique& technique : techniques())
    if (const char* reason = technique.plan.closestHits ? technique.plan.closestHits(request) : nullptr)
      return {Pass::Cast, true, reason};
  if (request.limits.obscurance > 0.0)
    return {Pass::Cast, true, "closest hits, because obscurance fades with the distance"};
  for (const Technique& technique : techniques())
    if (const char* reason =
            technique.plan.closestHitsOfSome ? technique.plan.closestHitsOfSome(request) : nullptr)
      return {Pass::Cast, true, reason};
  return {Pass::Cast, true, "any hit is enough, because nothing bounces"};
}

PlannedPass planAlbedo(const CompiledScene& scene, bool bounces) {
  const bool textured = scene.hasAlbedoTextures();
  return {Pass::AlbedoTextures, textured && bounces,
          !textured ? "no albedo has a texture"
          : bounces ? "senders reflect the colour of their textures"
                    : "only bounces use albedo"};
}

/// Returns why rays do not continue from mirrors and glass, or an empty text if they do.
std::string reasonAgainstSpecular(const BakeRequest& request, bool bounces) {
  if (!request.specular) return "not asked for (BakeRequest::specular)";
  if (transferOrder(request) == 0 && !(bounces && request.carriesLight()))
    return "no technique that is asked for carries light of the sky or bounces";
  const OcclusionLimits& limits = request.limits;
  if (limits.nearest > 0.0 || limits.farthest > 0.0 || limits.obscurance > 0.0)
    return "paths of light cannot have the limits of distance that are asked for";
  return "";
}

/// Returns which lamps' light is not carried on by transfer of the sky, or an empty text if none.
std::string exceptLampsWithin(const PlanInput& input) {
  if (transferOrder(input.request) == 0) return "";
  const std::string lamps = lampsWithin(input.scene);
  return lamps.empty() ? "" : "; the light of " + lamps + " within the scene is not carried on";
}

PlannedPass planSpecular(const PlanInput& input) {
  const std::vector<bool> used = usedMaterials(input.scene);
  const bool gloss = input.request.glossyBounces;
  std::size_t glass = 0, mirrors = 0, rough = 0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const CompiledMaterial& m = input.scene.materials[i];
    if (used[i] && carriesSpecularly(m)) isGlass(m) ? ++glass : ++mirrors;
    if (used[i] && gloss && carriesGloss(m)) ++rough;
  }
  if (glass + mirrors + rough == 0)
    return {Pass::SpecularTransport, false,
            gloss ? "no material is transmissive, mirror-like or glossy"
                  : "no material is transmissive or mirror-like"};
  const std::string against = reasonAgainstSpecular(input.request, input.bounces);
  const std::string counted =
      gloss ? fmt::format("{} transmissive, {} mirror-like and {} glossy materials", glass, mirrors, rough)
            : fmt::format("{} transmissive and {} mirror-like materials", glass, mirrors);
  if (against.empty())
    return {Pass::SpecularTransport, true,
            "rays go on from " + counted + " until they meet the sky or a diffuse surface" +
                exceptLampsWithin(input)};
  for (const Technique& technique : techniques())
    if (const char* by = technique.plan.specularLight ? technique.plan.specularLight(input.request) : nullptr)
      return {Pass::SpecularTransport, false,
              fmt::format("{} count as occluders: {} specular light", counted, by)};
  return {Pass::SpecularTransport, false, fmt::format("{} count as occluders: {}", counted, against)};
}

PlannedPass planSubsurface(const CompiledScene& scene, const BakeRequest& request) {
  if (!scene.hasDiffuseTransmission())
    return {Pass::SubsurfaceTransport, false,
            "no material lets light through diffusely or scatters it within"};
  if (!request.subsurface)
    return {Pass::SubsurfaceTransport, false, "not asked for (BakeRequest::subsurface)"};
  if (!request.ao && request.sh.order == 0 && request.ch.order == 0 && request.haar.size == 0)
    return {Pass::SubsurfaceTransport, false,
            "only AO, SH, CH and Haar wavelets keep light that passes through, and none is asked for"};
  return {Pass::SubsurfaceTransport, true,
          "both sides of transmitting surfaces are cast, and light that arrives on the other side is kept"};
}

PlannedPass planBackFaces(bool bounces, bool subsurface) {
  if (bounces) return {Pass::BackFaces, true, "cast only where the first rays meet a back"};
  if (subsurface)
    return {Pass::BackFaces, true,
            "backs of transmitting surfaces are cast, because light that arrives there is kept"};
  return {Pass::BackFaces, false, "only bounces use backs"};
}

}  // namespace

BakeRequest withChoices(BakeRequest request, const CompiledScene& scene) {
  for (const Technique& technique : techniques())
    if (technique.plan.choose != nullptr) technique.plan.choose(scene, request);
  return request;
}

BakeRequest carriedOut(BakeRequest request, const CarriedLight& light) {
  if (!light.bounces) request.bounces = 0;
  if (!light.specular) request.specular = request.glossyBounces = false;
  if (!light.subsurface) request.subsurface = false;
  return request;
}

CarriedLight lightOf(const Plan& plan) {
  return {plan.runs(Pass::Bounces), plan.runs(Pass::SpecularTransport), plan.runs(Pass::SubsurfaceTransport)};
}

Plan makePlan(const Scene& scene, const CompiledScene& compiled, const BakeRequest& asked) {
  checkRequest(asked);
  const BakeRequest request = withChoices(asked, compiled);
  Plan plan;
  const bool anything = compiled.triangleCount() > 0 && request.anything();
  const std::string nothing =
      compiled.triangleCount() == 0 ? "the scene has no triangles" : "no technique is asked for";
  if (request.visibility == Visibility::Raster) requireDrawable({scene, compiled, request, false});
  const PlannedPass bounces =
      anything ? planBounces(compiled, request) : PlannedPass{Pass::Bounces, false, nothing};
  const PlannedPass specular = planSpecular({scene, compiled, request, bounces.runs});
  const PlannedPass subsurface = planSubsurface(compiled, request);
  const BakeRequest planned =
      carriedOut(request, {bounces.runs, anything && specular.runs, anything && subsurface.runs});
  const PlanInput input{scene, compiled, planned, bounces.runs};
  const auto add = [&](const PlannedPass& pass) {
    plan.passes.push_back(anything || !pass.runs ? pass : PlannedPass{pass.name, false, nothing});
  };
  const auto addTechniques = [&](bool staticLight) {
    for (const Technique& technique : techniques())
      if (technique.plan.staticLight == staticLight && technique.plan.passes != nullptr)
        for (const PlannedPass& pass : technique.plan.passes(input)) add(pass);
  };
  const Instancing instancing = chooseInstancing(compiled);
  add(planCast(input));
  add(planInstances(instancing));
  const ShadowSets sets = anything ? makeShadowSets(compiled, request.shadowSets) : ShadowSets{};
  add(planShadowSets(sets, request));
  addTechniques(false);
  add(bounces);
  addTechniques(true);
  add(planBackFaces(bounces.runs, subsurface.runs));
  add(planTranslucent(compiled, bounces.runs));
  add({Pass::AlphaTest, compiled.hasAlphaMask(),
       compiled.hasAlphaMask() ? "a material is alpha-masked or blended"
                               : "no material is alpha-masked or blended"});
  add(planAlbedo(compiled, bounces.runs));
  add(specular);
  add(subsurface);
  if (anything) {
    for (const Technique& technique : techniques())
      if (technique.plan.addMemory != nullptr) technique.plan.addMemory(input, plan);
    estimateMemory(input, instancing, plan);
  }
  plan.deviceBytes += sets.treeTriangles() * treeBytesPerTriangle;
  return plan;
}

}  // namespace prelight
