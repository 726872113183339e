#include <gtest/gtest.h>

#include <cmath>

#include "photon/photon_tracer.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "stress/rays.h"
#include "support/devices.h"

// None of millions of photons is lost.
namespace prelight::test {
namespace {

constexpr std::size_t usualPhotons = 1'000'000;

TEST(PhotonAccounts, MillionsOfPhotons_LoseNothing) {
  for (const std::string name : {"caustics", "shapes"}) {
    Warnings warnings;
    const Scene source = loadScene(makeBuiltinScene(name), warnings);
    const CompiledScene scene = compileScene(source, warnings);
    TransportScene transport({scene, source.images, source.lights}, sharedDevice());
    PhotonRequest request;
    request.kind = PhotonKind::All;
    request.photons = stressRays(usualPhotons);
    Progress progress;
    std::uint64_t odd = 0, stored = 0;
    const PhotonReport report =
        PhotonTracer(scene, transport)
            .trace(
                request,
                [&](const PhotonHits& block) {
                  stored += block.photons.size();
                  for (const device::Photon& p : block.photons)
                    for (int c = 0; c < 3; ++c)
                      odd += !std::isfinite(p.power[c]) || p.power[c] < 0.0f || !std::isfinite(p.position[c]);
                },
                progress);
    EXPECT_EQ(odd, 0u) << name;
    EXPECT_EQ(stored, report.stored) << name;
    EXPECT_EQ(report.emitted, request.photons) << name;
    for (std::size_t c = 0; c < 3; ++c) {
      const PhotonPower& p = report.power;
      EXPECT_EQ(p.emitted[c], p.absorbed[c] + p.escaped[c] + p.cut[c]) << name << ' ' << c;
      EXPECT_GT(p.emitted[c], 0) << name;
    }
  }
}

}  // namespace
}  // namespace prelight::test
