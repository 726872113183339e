#include "support/occluders.h"

#include <algorithm>

#include "occluders/occluder_upload.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

class Maker {
 public:
  explicit Maker(std::uint32_t seed) : random_(seed) {}

  float unit() { return unit_(random_); }
  glm::vec3 direction() { return randomDirection(random_); }
  glm::vec3 color() { return {unit(), unit(), unit()}; }

  /// Random occluder vector of weight w. Every `none`th has no mean direction.
  glm::vec4 sum(float w, int i, int none) {
    const float resultant = i % none == 0 ? 0.0f : 0.3f + 0.699f * unit();
    return {direction() * (w * resultant), w};
  }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<float> unit_{0.0f, 1.0f};
};

glm::vec4 vectorOf(Maker& make, OccluderVector kind, float formFactor, int i) {
  switch (kind) {
    case OccluderVector::Position:
      return {3.0f * make.direction(), 0.2f + 3.0f * make.unit()};
    case OccluderVector::Occlusion:
      return make.sum(formFactor, i, 11);
    case OccluderVector::Caustic:
      return make.sum(i % 3 == 0 ? 0.0f : formFactor * make.unit(), i, 7);
    case OccluderVector::DiffuseNormal:
      return make.sum(formFactor * make.unit(), i, 5);
    case OccluderVector::SpecularNormal:
      return make.sum(i % 4 == 0 ? 0.0f : formFactor * make.unit(), i, 9);
    default:
      return {make.color(), 0.0f};
  }
}

}  // namespace

MadeOccluders makeOccluders(std::size_t vertices, std::vector<OccluderVector> optional, std::uint32_t seed) {
  Maker make(seed);
  MadeOccluders made;
  made.transfer.names = {"a", "b"};
  made.transfer.stored = std::move(optional);
  for (const OccluderVector always : {OccluderVector::Position, OccluderVector::Occlusion,
                                      OccluderVector::DiffuseNormal, OccluderVector::DiffuseColor})
    made.transfer.stored.push_back(always);
  std::sort(made.transfer.stored.begin(), made.transfer.stored.end());
  made.transfer.offsets = {0};
  for (std::size_t v = 0; v < vertices; ++v) {
    made.positions.push_back(1.5f * make.direction() * make.unit());
    made.normals.push_back(make.direction());
    made.gloss.emplace_back(v % 3 == 0 ? glm::vec3(0.0f) : make.color(), 0.1f + 0.9f * make.unit());
    const int records = static_cast<int>(v % 6);
    for (int i = 0; i < records; ++i) {
      const float formFactor = i % 4 == 3 ? 1e-5f : make.unit() / static_cast<float>(records);
      made.transfer.occluders.push_back(static_cast<std::uint32_t>(i % 2));
      for (const OccluderVector kind : made.transfer.stored)
        made.transfer.vectors.push_back(vectorOf(make, kind, formFactor, i + static_cast<int>(v)));
    }
    made.transfer.offsets.push_back(static_cast<std::uint32_t>(made.transfer.occluders.size()));
  }
  return made;
}

std::vector<OccluderVector> everyOptionalVector() {
  return {OccluderVector::Caustic, OccluderVector::Transmissive, OccluderVector::SpecularNormal,
          OccluderVector::SpecularColor};
}

OccluderReceiver receiverOf(const MadeOccluders& made, std::size_t vertex, const glm::dvec3& eye) {
  OccluderReceiver receiver;
  receiver.vertex = static_cast<std::uint32_t>(vertex);
  receiver.position = glm::dvec3(made.positions[vertex]);
  receiver.normal = glm::dvec3(made.normals[vertex]);
  receiver.toEye = glm::normalize(eye - receiver.position);
  receiver.f0 = glm::dvec3(glm::vec3(made.gloss[vertex]));
  receiver.roughness = made.gloss[vertex].w;
  return receiver;
}

OccluderShading unusualShading() {
  OccluderShading shading;
  shading.shadowStrength = 5.5;
  shading.bleeding = -0.7;
  shading.causticStrength = 0.6;
  shading.diffuseFromSpecular = 2.0;
  shading.specularFromSpecular = 3.0;
  shading.specularExponent = 20.0;
  shading.receiver = DiffuseReceiver::OrenNayar;
  shading.effects = {0.3, 2.0, 0.8, 0.37, 0.5};
  return shading;
}

std::vector<device::OccluderLight> makeLights(std::size_t count, std::uint32_t seed) {
  Maker make(seed);
  std::vector<device::OccluderLight> lights;
  for (std::size_t i = 0; i < count; ++i) {
    device::OccluderLight light =
        occluderPointLight(4.0f * make.direction() * (0.2f + make.unit()), 5.0f * make.color(), 0.01);
    const glm::vec3 way = make.direction();
    for (int c = 0; c < 3; ++c) light.direction[c] = way[c];
    light.kind = static_cast<float>(i % 4);
    if (i % 4 == PRELIGHT_LIGHT_EMITTER) light.extent = 0.3f;
    light.coneScale = 1.5f;
    light.coneOffset = 0.4f;
    light.range = i % 3 == 0 ? 9.0f : 0.0f;
    light.twoSided = i % 8 == 3 ? 1.0f : 0.0f;
    light.highlight = i % 5 == 4 ? 0.0f : 1.0f;
    lights.push_back(light);
  }
  return lights;
}

}  // namespace prelight::test
