#include "bake/baker.h"
#include "images/environment.h"

namespace prelight {

namespace {

std::uint64_t hashOf(const CompiledScene& scene) {
  StateHash hash;
  hash.values(scene.positions).values(scene.normals).values(scene.texCoords).values(scene.colors);
  hash.values(scene.triangles).values(scene.triangleMaterials).values(scene.triangleFlat);
  for (const CompiledMaterial& m : scene.materials) {
    for (int c = 0; c < 3; ++c) hash.value(m.albedo[c]);
    for (int c = 0; c < 3; ++c) hash.value(m.emission[c]);
    for (int c = 0; c < 3; ++c) hash.value(m.diffuseTransmission[c]);
    hash.value(m.doubleSided);
    hash.value(m.albedoImage).value(m.wrapS).value(m.wrapT).value(m.alphaCutoff).value(m.alphaFactor);
  }
  for (const Light& light : scene.lights) {
    hash.text(light.name).value(light.type).value(light.range);
    hash.value(light.innerConeAngle).value(light.outerConeAngle);
    for (int c = 0; c < 3; ++c)
      hash.value(light.intensity[c]).value(light.position[c]).value(light.direction[c]);
  }
  for (const PrimitiveRange& range : scene.primitives) hash.text(range.name).value(range.node);
  for (const Image& image : scene.albedoImages)
    hash.value(image.width).value(image.height).values(image.rgba);
  return hash.result();
}

std::uint64_t hashOf(const BakeRequest& request) {
  StateHash hash;
  hash.value(request.ao).value(request.shOrder).value(request.bounces).value(request.maxMemory);
  hash.value(request.chOrder).value(request.chNaive).value(request.haarSize).value(request.haarError);
  hash.value(request.volumeSize).value(request.texelSize);
  hash.value(request.glossyOrder).value(request.lightGroups).value(request.occluders);
  hash.value(request.occluderKind).value(request.occluderRecords).value(request.leastFormFactor);
  for (const LightGroupRequest& group : request.namedGroups) {
    hash.text(group.name);
    for (const std::string& pattern : group.patterns) hash.text(pattern);
  }
  for (const ShadowSetRequest& set : request.shadowSets) {
    hash.value(set.receivers.size()).value(set.occluders.size());
    for (const std::string& pattern : set.receivers) hash.text(pattern);
    for (const std::string& pattern : set.occluders) hash.text(pattern);
  }
  hash.value(request.nearLimit).value(request.farLimit).value(request.obscurance);
  hash.value(request.radiosity);
  hash.value(request.lightMap).value(request.lightMapTexel).value(request.lightMapError);
  hash.value(request.caustics).value(request.photons);
  if (request.radiosity || request.lightMap) {
    const RadiosityRequest& shape = request.radiosityShape;
    hash.value(shape.patchSize).value(shape.method).value(shape.tolerance).value(shape.skyRotation);
    hash.value(shape.environment != nullptr);
    if (shape.environment) hash.values(shape.environment->radiance);
  }
  // Rays a vertex are ignored beside the two others.
  hash.value(request.error.value_or(0.0)).value(request.seconds.value_or(0.0));
  hash.value(request.error || request.seconds ? 0 : request.rays);
  return hash.result();
}

std::uint64_t hashOf(const DeviceInfo& device) {
  return StateHash().text(device.name).text(device.platformVersion).text(device.driverVersion).result();
}

}  // namespace

StateKey bakeKey(const CompiledScene& scene, const BakeRequest& request, const DeviceInfo& device) {
  return {{"version of Prelight", StateHash().text(PRELIGHT_VERSION).result()},
          {"scene", hashOf(scene)},
          {"options", hashOf(request)},
          {"seed", StateHash().value(request.seed).result()},
          {"device", hashOf(device)}};
}

}  // namespace prelight
