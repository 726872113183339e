#include <span>
#include <utility>
#include <vector>

#include "benchmarks/suites/stability/cases.h"
#include "benchmarks/suites/stability/shapes.h"
#include "cast/specular_column.h"
#include "gpu/tracer.h"
#include "integrators/reference.h"
#include "shared/cast_types.h"

// Light that walks within bodies which scatter it.
namespace prelight::benchmarks::stability {

namespace {

using device::CastParameters;
using device::Hit;
using device::Ray;
using device::Receiver;
using device::SpecularEnd;

constexpr std::uint32_t walkReceivers = 16, walkRays = 64;
constexpr double roundingsAStep =
    32.0 * unitRoundoff;  // exponentials, quotients, and what they are multiplied to

/// A ball that scatters all light and absorbs none, of so many mean free paths, seen from outside.
CompiledScene whiteBall(double radius, double depth, double emission) {
  CompiledScene ball = hollowSphere(radius, 2, matte(0.0, emission));
  for (glm::uvec3& t : ball.triangles) std::swap(t.y, t.z);
  for (glm::vec3& n : ball.normals) n = -n;
  CompiledMaterial& m = ball.materials[0];
  m.solid = true;
  m.doubleSided = true;
  m.translucency = m.meanTranslucency = 1.0f;
  m.diffuseTransmission = glm::vec3(1.0f);
  m.absorption = glm::vec3(static_cast<float>(depth / radius));
  m.scattering = glm::vec3(1.0f);
  return ball;
}

/// Rays from the middle carry what they began with to the surface.
void weights(const char* stress, double radius, double depth, Trials& trials) {
  DeviceContext& device = trials.context();
  const CompiledScene scene = whiteBall(radius, depth, 0.0);
  Tracer tracer(scene, trials.device());
  Random random(53);
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < walkReceivers * walkRays; ++i) {
    const glm::vec3 d(random.direction());
    rays.push_back({{0.0f, 0.0f, 0.0f}, PRELIGHT_NO_TRIANGLE, {d.x, d.y, d.z}, 1e30f});
  }
  const CastParameters parameters{walkReceivers, walkRays, 0, scene.vertexCount(), 0, 0.0f, 0.0f, 0.0f};
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  std::vector<Receiver> receivers(walkReceivers);
  for (std::uint32_t r = 0; r < walkReceivers; ++r) receivers[r].seed = r;
  const Buffer<Receiver> receiverBuffer(device, std::span<const Receiver>(receivers));
  const Buffer<Ray> rayBuffer(device, std::span<const Ray>(rays));
  Buffer<Hit> hits(device, rays.size());
  tracer.traceClosest(rayBuffer, hits, rays.size());
  SpecularCaster caster(scene, {false, true, 0, nullptr}, tracer, rays.size(), walkRays);
  caster.cast({parameterBuffer, receiverBuffer, rayBuffer, hits}, walkReceivers, tracer);
  Differences differences;
  for (const SpecularEnd& end : caster.ends().read()) {
    differences.decide(end.kind == PRELIGHT_SPECULAR_SURFACE);
    for (const float share : end.throughput) differences.add(share, 1.0);
  }
  trials.record(stress, differences, roundingsAStep * (1.0 + depth * depth), {"mean free paths", depth});
}

/// The light that the inside of the ball emits is seen from its middle whatever is in between.
void seenFromWithin(double depth, Trials& trials) {
  constexpr double emission = 2.0;
  const CompiledScene scene = whiteBall(1.0, depth, emission);
  reference::ReferenceRequest request;
  request.width = request.height = 4;
  request.samples = 16;
  request.depth = 1;
  Progress progress;
  reference::Film film;
  reference::ReferenceReport report;
  const Camera camera = cameraAt(glm::dvec3(0.0), {0.3, 0.1, 1.0}, 1.0);
  reference::renderReference({scene, noImages(), {}, camera}, request, trials.device(), progress, film,
                             report);
  Differences differences;
  for (const glm::vec3& pixel : film.picture().pixels)
    for (int c = 0; c < 3; ++c) differences.add(pixel[c], emission);
  trials.record("a picture from within", differences, roundingsAStep * (1.0 + depth * depth),
                {"mean free paths", depth});
}

}  // namespace

void runWalks(Trials& trials) {
  for (const double depth : {1e-3, 1.0, 16.0}) weights("thicker and thicker", 1.0, depth, trials);
  weights("a ball of 1e-5 m", 1e-5, 4.0, trials);
  weights("a ball of 1e5 m", 1e5, 4.0, trials);
  for (const double depth : {1.0, 8.0}) seenFromWithin(depth, trials);
}

}  // namespace prelight::benchmarks::stability
