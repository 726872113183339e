#include <array>
#include <cmath>
#include <functional>

#include "basis/cube_map.h"
#include "basis/sh_products.h"
#include "basis/sh_projection.h"
#include "benchmarks/suites/stability/cases.h"
#include "benchmarks/suites/stability/shapes.h"
#include "photon/photon_maps.h"
#include "prelight/error.h"
#include "prelight/transfer.h"
#include "scene/surface_regions.h"

// Values that are no numbers must not reach a kernel: the host refuses them.
namespace prelight::benchmarks::stability {

namespace {

constexpr std::array<float, 3> noNumbers = {NAN, INFINITY, -INFINITY};

bool refuses(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error&) {
    return true;
  }
  return false;
}

void photons(Trials& trials) {
  const CompiledScene scene = floorScene(1.0, 1, matte(1.0));
  const DensitySurface surface = makeDensitySurface(scene, makeSurfaceRegions(scene, usualCreaseAngle));
  Differences differences;
  const auto judge = [&](const device::Photon& photon, bool right) {
    differences.decide(refuses([&] { makePhotonMaps(std::span(&photon, 1), surface); }) != right);
  };
  const device::Photon good{{0, 0, 0}, 0, {1, 1, 1}, 0};
  judge(good, true);
  for (int k = 0; k < 3; ++k) {
    for (const float value : noNumbers) {
      device::Photon bad = good;
      bad.position[k] = value;
      judge(bad, false);
      bad = good;
      bad.power[k] = value;
      judge(bad, false);
    }
    device::Photon bad = good;
    bad.power[k] = -1.0f;
    judge(bad, false);
  }
  device::Photon lost = good;
  lost.triangle = 7;
  judge(lost, false);
  trials.record("photons", differences, 0.0);
}

void lights(Trials& trials) {
  Differences differences;
  for (const float value : {NAN, INFINITY, -INFINITY, -1.0f}) {
    CubeMap map{1, std::vector<glm::vec3>(6, glm::vec3(1.0f))};
    differences.decide(!refuses([&] { checkCubeMap(map, "map"); }));
    map.radiance[3].y = value;
    differences.decide(refuses([&] { checkCubeMap(map, "map"); }));
    Environment sky{4, 2, std::vector<glm::vec3>(8, glm::vec3(1.0f))};
    differences.decide(!refuses([&] { sh::projectEnvironment(sky, 3); }));
    sky.radiance[5].z = value;
    differences.decide(refuses([&] { sh::projectEnvironment(sky, 3); }));
    differences.decide(refuses([&] { cubeFromEnvironment(sky, 4); }));
  }
  trials.record("skies and cube maps", differences, 0.0);
}

void transfer(Trials& trials) {
  Differences differences;
  for (const float value : noNumbers) {
    HarmonicTransfer transfer{2, 1, 0, std::vector<float>(40, 0.5f)};
    for (const char* method : {"half", "band8", "pca:2", "vq:3", "cpca:2:1"}) {
      transfer.coefficients[13] = 0.25f;
      differences.decide(!refuses([&] { compress(transfer, parseCompression(method)); }));
      transfer.coefficients[13] = value;
      differences.decide(refuses([&] { compress(transfer, parseCompression(method)); }));
    }
    std::vector<double> function(9, 1.0);
    function[4] = double(value);
    differences.decide(refuses([&] { sh::productMatrix(function, 3, 2); }));
  }
  trials.record("transfer and coefficients", differences, 0.0);
}

}  // namespace

void runRefusals(Trials& trials) {
  photons(trials);
  lights(trials);
  transfer(trials);
}

}  // namespace prelight::benchmarks::stability
