// Pictures with transfer for both sides of a surface, compared with closed forms.
#include <gtest/gtest.h>

#include "viewer/open_transfers.h"
#include "viewer/picture_checks.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

constexpr double beyond = 0.25;  // Share of the sky on the other side.

/// A quad that fills the picture, seen from its front or its back under a sky of radiance 1. In front of it
/// all of the sky is visible, behind it a part.
QuadScene leafQuad(bool fromBehind) {
  QuadScene quad;
  Material material = lambertian({0.8f, 0.6f, 0.4f});
  material.diffuseTransmission = 0.5f;
  material.diffuseTransmissionColor = {0.2f, 0.4f, 0.6f};
  material.doubleSided = true;
  quad.add(material);
  quad.lookFrom({0.0, 0.0, fromBehind ? -0.5 : 0.5}, {0.0, 0.0, 0.0});
  quad.setSky(Environment{2, 1, {glm::vec3(1.0f), glm::vec3(1.0f)}});
  quad.compile();
  quad.bakeOpen(3);
  return quad;
}

/// Transfer of the other side: that of the fronts in quad.bake, darkened.
ThroughTransfer darker(const Bake& bake) {
  ThroughTransfer through;
  through.ao.assign(bake.ao.size(), static_cast<float>(beyond));
  through.sh = bake.sh;
  for (float& value : through.sh->coefficients) value *= static_cast<float>(beyond);
  return through;
}

class ThroughShading : public ::testing::TestWithParam<bool> {};

TEST_P(ThroughShading, Sh_AddsWhatComesThroughFromTheOtherSide) {
  const bool behind = GetParam();
  QuadScene quad = leafQuad(behind);
  quad.bake.through = darker(quad.bake);
  const double here = behind ? beyond : 1.0, there = behind ? 1.0 : beyond;
  const glm::dvec3 albedo(0.4, 0.3, 0.2), through(0.1, 0.2, 0.3);
  expectColor(pixelAt(quad.render(square(Shading::Sh))), albedo * here + through * there, 2e-3);
}

TEST_P(ThroughShading, Ao_KnowsHowOpenTheOtherSideIs) {
  const bool behind = GetParam();
  QuadScene quad = leafQuad(behind);
  quad.bake.through = darker(quad.bake);
  const double here = behind ? beyond : 1.0, there = behind ? 1.0 : beyond;
  const glm::dvec3 albedo(0.4, 0.3, 0.2), through(0.1, 0.2, 0.3);
  expectColor(pixelAt(quad.render(square(Shading::Ao))), albedo * here + through * there, 2e-3);
}

TEST_P(ThroughShading, Haar_AddsWhatComesThroughFromTheOtherSide) {
  const bool behind = GetParam();
  QuadScene quad = leafQuad(behind);
  quad.bake.haar = openWavelets(quad.compiled.normals, 8, 1);
  quad.bake.through.emplace();
  quad.bake.through->haar = quad.bake.haar;
  for (float& value : quad.bake.through->haar->values) value *= static_cast<float>(beyond);
  const double here = behind ? beyond : 1.0, there = behind ? 1.0 : beyond;
  const glm::dvec3 albedo(0.4, 0.3, 0.2), through(0.1, 0.2, 0.3);
  expectColor(pixelAt(quad.render(square(Shading::Haar))), albedo * here + through * there, 4e-3);
}

TEST_P(ThroughShading, WithoutTransferOfTheOtherSide_BacksShowTheFronts) {
  const QuadScene quad = leafQuad(GetParam());
  expectColor(pixelAt(quad.render(square(Shading::Sh))), glm::dvec3(0.4, 0.3, 0.2), 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Sides, ThroughShading, ::testing::Bool());

}  // namespace
}  // namespace prelight
