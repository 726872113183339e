#include "bake/baker.h"
#include "io/scene_fingerprint.h"
#include "prelight/picture.h"
#include "scene/scene_hash.h"
#include "techniques/registry/registry.h"

namespace prelight {

namespace {

std::uint64_t hashOf(const CompiledScene& scene) {
  StateHash hash;
  addGeometry(scene, hash);
  addMaterials(scene, hash);
  for (const Light& light : scene.lights) {
    hash.text(light.name);
    addLight(light, hash);
  }
  for (const PrimitiveRange& range : scene.primitives) hash.text(range.name).value(range.node);
  for (const Image& image : scene.images) hash.value(image.width).value(image.height).values(image.rgba);
  for (const EmissionParts::Part& part : scene.emissionParts.parts)
    for (int c = 0; c < 3; ++c) hash.value(part.origin[c % 2]).value(part.scale).value(part.color[c]);
  return hash.result();
}

/// Adds the options that the irradiance of the scene's own lights depends on: those of its solution and the
/// sky.
void addStaticLight(const BakeRequest& request, StateHash& hash) {
  if (!request.radiosity && !request.lightMap) return;
  const RadiosityRequest& shape = request.radiosity;
  hash.value(shape.patchSize).value(shape.method).value(shape.tolerance).value(shape.skyRotation);
  hash.value(shape.environment != nullptr);
  if (shape.environment) hash.values(shape.environment->radiance);
}

/// Adds what limits visibility: shadow sets, and the nearest and farthest distance that count.
void addVisibility(const BakeRequest& request, StateHash& hash) {
  for (const ShadowSetRequest& set : request.shadowSets) {
    hash.value(set.receivers.size()).value(set.occluders.size());
    for (const std::string& pattern : set.receivers) hash.text(pattern);
    for (const std::string& pattern : set.occluders) hash.text(pattern);
  }
  hash.value(request.limits.nearest).value(request.limits.farthest).value(request.limits.obscurance);
}

/// Adds how views are found, if not by rays.
void addViews(const BakeRequest& request, StateHash& hash) {
  if (request.visibility != Visibility::Rays) hash.value(request.visibility);
}

/// Adds whole materials where light passes mirrors, glass or bodies, as their scattering depends on all
/// members.
void addFurtherWays(const CompiledScene& scene, const BakeRequest& request, StateHash& hash) {
  if (!request.specular && !request.subsurface) return;
  if (request.specular) hash.text(request.glossyBounces ? "glossy" : "specular");
  for (const CompiledMaterial& m : scene.materials) addMaterial(m, hash);
}

std::uint64_t hashOf(const CompiledScene& scene, const BakeRequest& request) {
  StateHash hash;
  for (const Technique& technique : techniques())
    if (technique.plan.addToKey != nullptr) technique.plan.addToKey(request, hash);
  hash.value(request.bounces).value(request.memory());
  addVisibility(request, hash);
  addViews(request, hash);
  addFurtherWays(scene, request, hash);
  addStaticLight(request, hash);
  // An error bound or a time limit overrides the number of rays per vertex.
  hash.value(request.effort.error.value_or(0.0)).value(request.effort.seconds.value_or(0.0));
  hash.value(request.effort.error || request.effort.seconds ? 0 : request.effort.rays);
  return hash.result();
}

std::uint64_t hashOf(const DeviceInfo& device) {
  return StateHash().text(device.name).text(device.platformVersion).text(device.driverVersion).result();
}

/// Number of the layout of what a bake writes into its state. It grows with every change of that.
constexpr std::uint32_t stateLayout = 4;

}  // namespace

StateKey bakeKey(const CompiledScene& scene, const BakeRequest& request, const DeviceInfo& device) {
  return {{"version of Prelight", StateHash().text(PRELIGHT_VERSION).value(stateLayout).result()},
          {"scene", hashOf(scene)},
          {"options", hashOf(scene, request)},
          {"seed", StateHash().value(request.seed).result()},
          {"device", hashOf(device)}};
}

}  // namespace prelight
