#include "support/bakes_of_everything.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "encodings/registry/registry.h"
#include "support/scenes.h"

namespace prelight::test {

CompiledScene groundAndSphere() {
  CompiledScene scene = test::ground(4, 2.0f);
  test::append(scene, test::sphere(6, 0.5f, {0.0f, 0.8f, 0.0f}));
  for (auto& material : scene.materials) {
    material.albedo = glm::vec3(0.7f);
    material.doubleSided = true;
  }
  scene.materials[1].emission = glm::vec3(2.0f);
  return scene;
}

BakeRequest vertexTransferRequest(int bounces) {
  BakeRequest request;
  request.ao = true;
  request.sh.order = 2;
  request.bounces = bounces;
  request.effort.rays = 512;
  return request;
}

BakeRequest vertexRequest() {
  BakeRequest request = vertexTransferRequest(1);
  request.ch.order = 2;
  request.haar.size = 4;
  request.glossy.order = 2;
  request.lightGroups.wanted = true;
  request.volume.size = 4;
  request.cones = true;
  request.horizons.sectors = 8;
  request.nearLamps.shells = 2;
  return request;
}

BakeRequest occluderRequest() {
  BakeRequest request = vertexTransferRequest(0);
  request.occluders.wanted = true;
  return request;
}

BakeRequest errorRequest() {
  BakeRequest request = vertexTransferRequest(1);
  request.effort.error = 0.02;
  return request;
}

BakeRequest radiosityRequest() {
  BakeRequest request;
  request.radiosity.wanted = true;
  request.radiosity.patchSize = 0.5;
  request.effort.rays = 64;
  return request;
}

BakeRequest lightMapRequest() {
  BakeRequest request;
  request.lightMap.wanted = true;
  request.lightMap.texelSize = 0.06;
  request.lightMap.photons = 20'000;
  request.effort.rays = 16;
  request.encodedLight.encodings = {std::string(encodings().front().name)};
  return request;
}

BakeRequest texelErrorRequest() {
  BakeRequest request;
  request.lightMap.wanted = true;
  request.lightMap.error = 0.2;
  request.lightMap.photons = 20'000;
  request.effort.rays = 16;
  return request;
}

namespace {

void expectSame(const std::optional<HarmonicTransfer>& part, const std::optional<HarmonicTransfer>& whole) {
  ASSERT_EQ(part.has_value(), whole.has_value());
  if (part) {
    EXPECT_EQ(part->coefficients, whole->coefficients);
  }
}

void expectSameVertices(const Bake& part, const Bake& whole) {
  EXPECT_EQ(part.ao, whole.ao);
  EXPECT_EQ(part.bentNormals, whole.bentNormals);
  EXPECT_EQ(part.apertures, whole.apertures);
  expectSame(part.sh, whole.sh);
  expectSame(part.ch, whole.ch);
  if (whole.haar) {
    EXPECT_EQ(part.haar->offsets, whole.haar->offsets);
    EXPECT_EQ(part.haar->indices, whole.haar->indices);
    EXPECT_EQ(part.haar->values, whole.haar->values);
  }
  if (whole.glossy) {
    EXPECT_EQ(part.glossy->matrices, whole.glossy->matrices);
  }
  if (whole.lightGroups) {
    EXPECT_EQ(part.lightGroups->coefficients, whole.lightGroups->coefficients);
  }
  if (whole.horizons) {
    EXPECT_EQ(part.horizons->angles, whole.horizons->angles);
  }
  if (whole.nearLamps) {
    EXPECT_EQ(part.nearLamps->halves, whole.nearLamps->halves);
  }
  if (whole.occluders) {
    EXPECT_EQ(part.occluders->vectors, whole.occluders->vectors);
  }
  EXPECT_EQ(part.irradiance, whole.irradiance);
}

}  // namespace

void expectSame(const Bake& part, const Bake& whole) {
  expectSameVertices(part, whole);
  if (whole.volume) {
    EXPECT_EQ(part.volume->air, whole.volume->air);
    EXPECT_EQ(part.volume->coefficients, whole.volume->coefficients);
    EXPECT_EQ(part.volume->sent, whole.volume->sent);
    EXPECT_EQ(part.volume->lights, whole.volume->lights);
  }
  if (whole.lightMap) {
    EXPECT_EQ(part.lightMap->values, whole.lightMap->values);
    ASSERT_EQ(part.lightMap->encoded.size(), whole.lightMap->encoded.size());
    for (std::size_t i = 0; i < whole.lightMap->encoded.size(); ++i) {
      EXPECT_EQ(part.lightMap->encoded[i].values, whole.lightMap->encoded[i].values);
      EXPECT_EQ(part.encodedLight[i].values, whole.encodedLight[i].values);
    }
  }
  EXPECT_EQ(part.info.rays, whole.info.rays);
}

}  // namespace prelight::test
