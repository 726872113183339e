#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gpu/transport_scene.h"
#include "photon/photon_tracer.h"
#include "scene/light_profile.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/profiles.h"

// Photons of lamps with profiles (EXT_lights_ies).
namespace prelight::test {
namespace {

using std::numbers::pi;

double uneven(double height, double turn) {
  return 0.2 + std::pow(std::max(std::cos(height), 0.0), 6.0) * (3.0 + 2.0 * std::cos(turn)) +
         std::pow(std::max(-std::cos(height), 0.0), 2.0) * (0.7 + 0.5 * std::sin(3.0 * turn));
}

struct Emitted {
  PhotonHits hits;
  glm::dvec3 watts{0.0};
};

/// Emits from a lamp in a nearly black box, where every photon is stored at its first hit.
Emitted emit(const Light& lamp, std::uint64_t photons) {
  CompiledScene scene = box(1, glm::vec3(-1.0f), glm::vec3(1.0f), true);
  scene.materials[0] = lambert(1e-6f);
  const std::vector<Image> images;
  TransportScene transport({scene, images, {lamp}, nullptr}, sharedDevice());
  PhotonTracer tracer(scene, transport);
  PhotonRequest request;
  request.kind = PhotonKind::All;
  request.photons = photons;
  Emitted emitted;
  Progress progress;
  const PhotonReport report = tracer.trace(request, emitted.hits, progress);
  emitted.watts = report.power.watts(report.power.emitted);
  return emitted;
}

TEST(ProfileEmission, Power_IsTheIntegralOfTheProfile) {
  Light lamp = profiledLight({0.2, 0.1, -0.1}, makeProfile(cosineLobe), glm::normalize(glm::dvec3(1, 2, 3)),
                             glm::normalize(glm::dvec3(2, -1, 0)));
  lamp.intensity = {2.0f, 1.0f, 0.5f};
  const glm::dvec3 watts = emit(lamp, 1 << 16).watts;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(watts[c], pi * static_cast<double>(lamp.intensity[c]),
                2e-3 * pi * static_cast<double>(lamp.intensity[c]));
}

/// Chi-square test over cells of equal turns and cosines against the profile by quadrature, and the power
/// that photons carry.
TEST(ProfileEmission, Directions_FollowTheProfile) {
  constexpr int rings = 20, sectors = 12, fine = 20;
  constexpr std::size_t count = 1 << 17;
  const glm::dvec3 aim = glm::normalize(glm::dvec3(0.3, -1, 0.2)),
                   side = glm::normalize(glm::cross(aim, glm::dvec3(0, 0, 1)));
  const Light lamp = profiledLight({0, 0, 0}, makeProfile(uneven), aim, side);
  const Emitted emitted = emit(lamp, count);
  ASSERT_EQ(emitted.hits.photons.size(), count);
  std::vector<double> found(rings * sectors, 0.0), carried(found), expected(found);
  for (const device::Photon& photon : emitted.hits.photons) {
    const glm::dvec3 d =
        glm::normalize(glm::dvec3(photon.position[0], photon.position[1], photon.position[2]));
    const double turn = std::atan2(glm::dot(d, glm::cross(-aim, side)), glm::dot(d, side)) / (2.0 * pi);
    const int ring = std::clamp(static_cast<int>((1.0 - glm::dot(d, aim)) / 2.0 * rings), 0, rings - 1);
    const int sector = std::clamp(static_cast<int>((turn - std::floor(turn)) * sectors), 0, sectors - 1);
    found[static_cast<std::size_t>(ring * sectors + sector)] += 1.0;
    carried[static_cast<std::size_t>(ring * sectors + sector)] += static_cast<double>(photon.power[0]);
  }
  double all = 0.0;
  for (int r = 0; r < rings * fine; ++r)
    for (int s = 0; s < sectors * fine; ++s) {
      const double height = std::acos(1.0 - 2.0 * (r + 0.5) / (rings * fine));
      const double watts = uneven(height, 2.0 * pi * (s + 0.5) / (sectors * fine)) * 4.0 * pi /
                           (rings * fine * sectors * fine);
      expected[static_cast<std::size_t>(r / fine * sectors + s / fine)] += watts;
      all += watts;
    }
  EXPECT_NEAR(emitted.watts.x, all, 3e-3 * all);
  double chiSquare = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double photons = expected[i] / all * count;
    chiSquare += (found[i] - photons) * (found[i] - photons) / photons;
    EXPECT_NEAR(carried[i], expected[i], expected[i] * (4.0 / std::sqrt(photons) + 0.01)) << i;
  }
  EXPECT_LT(chiSquare, rings * sectors + 4.0 * std::sqrt(2.0 * rings * sectors));
  // All photons carry nearly the same power.
  const auto [least, most] = std::minmax_element(
      emitted.hits.photons.begin(), emitted.hits.photons.end(),
      [](const device::Photon& a, const device::Photon& b) { return a.power[0] < b.power[0]; });
  EXPECT_GT(least->power[0], 0.3f * most->power[0]);
}

}  // namespace
}  // namespace prelight::test
