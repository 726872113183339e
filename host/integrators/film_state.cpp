#include "integrators/film_state.h"

#include "scene/light_hash.h"
#include "scene/material_hash.h"

namespace prelight::reference {

namespace {

void addVector(StateHash& hash, const glm::dvec3& v) { hash.value(v.x).value(v.y).value(v.z); }

std::uint64_t sceneHash(const ReferenceInputs& inputs) {
  const CompiledScene& s = inputs.scene;
  StateHash hash;
  addVector(hash, s.origin);
  hash.values(s.positions).values(s.normals).values(s.colors).values(s.triangles);
  hash.values(s.texCoords).values(s.texCoords1).values(s.tangents);
  hash.values(s.triangleMaterials).values(s.triangleFlat);
  for (const CompiledMaterial& m : s.materials) addMaterial(m, hash);
  for (const Image& image : inputs.images) hash.value(image.width).value(image.height).values(image.rgba);
  return hash.result();
}

std::uint64_t lightsHash(const std::vector<Light>& lights) {
  StateHash hash;
  for (const Light& light : lights) addLight(light, hash);
  return hash.result();
}

std::uint64_t cameraHash(const Camera& camera) {
  StateHash hash;
  for (int column = 0; column < 4; ++column) addVector(hash, glm::dvec3(camera.world[column]));
  hash.value(camera.perspective ? 1 : 0);
  for (const double v : {camera.yFov, camera.zNear, camera.zFar, camera.xMag, camera.yMag}) hash.value(v);
  return hash.result();
}

std::uint64_t skyHash(const ReferenceInputs& inputs) {
  StateHash hash;
  hash.value(inputs.skyRotation);
  if (inputs.sky != nullptr)
    hash.value(inputs.sky->width).value(inputs.sky->height).values(inputs.sky->radiance);
  return hash.result();
}

std::uint64_t effortHash(const ReferenceRequest& request) {
  return StateHash()
      .value(request.samples)
      .value(request.error.value_or(0.0))
      .value(request.seconds.value_or(0.0))
      .result();
}

}  // namespace

StateKey filmKey(const ReferenceInputs& inputs, const ReferenceRequest& request, const DeviceInfo& device) {
  const auto number = [](auto value) { return StateHash().value(value).result(); };
  return {
      {"scene", sceneHash(inputs)},
      {"lights", lightsHash(inputs.lights)},
      {"camera", cameraHash(inputs.camera)},
      {"sky or rotation of it", skyHash(inputs)},
      {"size", StateHash().value(request.width).value(request.height).result()},
      {"integrator", number(static_cast<int>(request.integrator) + 4 * static_cast<int>(request.estimator))},
      {"number of light paths", number(request.lightPaths)},
      {"depth", number(request.depth + 65536 * request.rouletteDepth)},
      {"effort (samples, error or time)", effortHash(request)},
      {"seed", number(request.seed)},
      {"parts of the picture", number(request.parts ? 1 : 0)},
      {"device", StateHash().text(device.name).text(device.driverVersion).result()},
      {"version of Prelight", StateHash().text(PRELIGHT_VERSION).result()}};
}

}  // namespace prelight::reference
