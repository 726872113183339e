#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "benchmarks/suites/stability/cases.h"
#include "cast/specular_column.h"
#include "device/kernel.h"
#include "gpu/tracer.h"
#include "integrators/reference.h"
#include "oracle/brute_force.h"
#include "receivers/sampling.h"
#include "shared/cast_types.h"

// Light that is scattered within bodies.

namespace prelight::benchmarks::stability {

namespace {

using device::CastParameters;
using device::Hit;
using device::Ray;
using device::Receiver;

Receiver receiverOf(const glm::vec3& position, const glm::vec3& n, std::uint32_t seed,
                    std::uint32_t firstSample) {
  return {{position.x, position.y, position.z}, 7, {n.x, n.y, n.z}, seed, {n.x, n.y, n.z}, firstSample};
}

/// Returns the position of a point of the square along the kernel's Morton curve, which halves columns first.
std::uint32_t slotOf(const glm::dvec2& u, unsigned bits) {
  const unsigned p = (bits + 1) / 2, q = bits / 2;
  const auto column = static_cast<std::uint32_t>(u.x * (1u << p)),
             row = static_cast<std::uint32_t>(u.y * (1u << q));
  std::uint32_t slot = 0;
  for (unsigned k = 0; k < bits; ++k) {
    const unsigned level = k / 2;
    const std::uint32_t bit = k % 2 == 0 ? column >> (p - 1 - level) & 1u : row >> (q - 1 - level) & 1u;
    slot |= bit << (bits - 1 - k);
  }
  return slot;
}

void generate(const char* stress, const std::vector<Receiver>& receivers, std::uint32_t count,
              Trials& trials) {
  DeviceContext& device = trials.context();
  const CastParameters parameters{
      static_cast<std::uint32_t>(receivers.size()), count, 4, 0, 0, 0.0f, 0.0f, 0.0f};
  const Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  const Buffer<Receiver> receiverBuffer(device, std::span<const Receiver>(receivers));
  const Buffer<Ray> buffer(device, receivers.size() * count);
  launchOnce(device, "cast/generate_kernels.cl", {}, "generateRays", buffer.size() / 8, parameterBuffer,
             receiverBuffer, buffer);
  const std::vector<Ray> rays = buffer.read();
  const unsigned bits = static_cast<unsigned>(std::countr_zero(count));
  Differences differences;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const Receiver& r = receivers[i];
    const glm::dvec3 n = glm::normalize(glm::dvec3(r.normal[0], r.normal[1], r.normal[2]));
    for (std::uint32_t sample = 0; sample < count; ++sample) {
      const glm::dvec2 u = sampling::sobol(r.firstSample + sample, r.seed);
      const Ray& ray = rays[i * count + slotOf(u, bits)];
      const glm::dvec3 truth = sampling::cosineHemisphere(u, n);
      for (int axis = 0; axis < 3; ++axis) {
        differences.add(ray.direction[axis], truth[axis], 1.0);
        differences.add(ray.origin[axis], r.position[axis]);
      }
    }
  }
  trials.record(stress, differences, std::sqrt(unitRoundoff), {"rays per receiver", double(count)});
}

std::vector<Receiver> receiversAt(const std::vector<glm::vec3>& normals, double place, bool late,
                                  std::uint32_t count) {
  Random random(2);
  std::vector<Receiver> receivers;
  for (const glm::vec3& n : normals) {
    // The sequence ends at 2^32, and blocks begin at multiples of their length.
    const std::uint32_t first =
        late ? 0u - count * (1u + random.bits() % 4u) : count * (random.bits() % 1000u);
    receivers.push_back(receiverOf(glm::vec3(place * random.direction()), n, random.bits(), first));
  }
  return receivers;
}

/// Random triangles and the points at which rays aim.
struct Soup {
  CompiledScene scene;
  double size = 1.0;
  glm::dvec3 centre{0.0};
};

/// Returns random triangles of about `size` within a cube of 4 sizes about `away`; `slim`: a millionth as
/// wide.
Soup soupOf(double size, const glm::dvec3& away, bool slim) {
  Random random(5);
  Soup soup{floorScene(1.0, 1, matte(1.0)), size, away};
  CompiledScene& scene = soup.scene;
  scene.positions.clear();
  scene.triangles.clear();
  for (std::uint32_t i = 0; i < 60; ++i) {
    const glm::dvec3 corner =
        away + size * glm::dvec3(random.between(-2, 2), random.between(-2, 2), random.between(-2, 2));
    const glm::dvec3 along = random.direction(), other = random.direction();
    const glm::dvec3 across = glm::normalize(other - glm::dot(other, along) * along);
    scene.positions.emplace_back(corner);
    scene.positions.emplace_back(corner + size * along);
    scene.positions.emplace_back(corner + size * (0.5 * along + (slim ? 1e-3 : 1.0) * across));
    scene.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const std::size_t vertices = scene.positions.size();
  scene.origin = glm::dvec3(0.0);
  scene.normals.assign(vertices, glm::vec3(0, 1, 0));
  scene.texCoords.assign(vertices, glm::vec2(0.0f));
  scene.triangleMaterials.assign(60, 0);
  scene.triangleFlat.assign(60, 1);
  scene.boundsMin = glm::vec3(away - 4.0 * size);
  scene.boundsMax = glm::vec3(away + 4.0 * size);
  scene.primitives = {{0, 0, 0, 0, static_cast<std::uint32_t>(vertices), 0, 60, {}, 0}};
  return soup;
}

Ray rayOf(const glm::dvec3& origin, const glm::dvec3& direction) {
  const glm::vec3 o(origin), d(direction);
  return {{o.x, o.y, o.z}, PRELIGHT_NO_TRIANGLE, {d.x, d.y, d.z}, std::numeric_limits<float>::max()};
}

enum class Aim { Straight, Grazing, Long, Short, Axis };

std::vector<Ray> raysAt(const Soup& soup, Aim aim, std::size_t count) {
  Random random(6);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const auto t = static_cast<std::uint32_t>(random.bits() % soup.scene.triangleCount());
    const glm::uvec3& v = soup.scene.triangles[t];
    double b = random.between(0.1, 0.4), c = random.between(0.1, 0.4);
    const glm::dvec3 p(soup.scene.positions[v.x]), q(soup.scene.positions[v.y]), r(soup.scene.positions[v.z]);
    const glm::dvec3 target = p + b * (q - p) + c * (r - p);
    const glm::dvec3 n = glm::normalize(glm::cross(q - p, r - p));
    glm::dvec3 away = random.direction();
    if (aim == Aim::Grazing) away = glm::normalize(away - (1.0 - 1e-3) * glm::dot(away, n) * n);
    if (aim == Aim::Axis) away = glm::dvec3(t % 3 == 0, t % 3 == 1, t % 3 == 2);
    const glm::vec3 origin(target + 3.0 * soup.size * away);
    glm::dvec3 direction = target - glm::dvec3(origin);
    if (aim == Aim::Long) direction *= 1e18 / soup.size;
    if (aim == Aim::Short) direction *= 1e-22 / soup.size;
    if (aim == Aim::Axis) direction = -away + glm::dvec3(1e-40);
    rays.push_back(rayOf(glm::dvec3(origin), direction));
  }
  return rays;
}

/// Returns the distance of a hit from the plane of its triangle.
double offPlane(const CompiledScene& scene, const Ray& ray, const Hit& hit, double* reach) {
  const glm::dvec3 o(ray.origin[0], ray.origin[1], ray.origin[2]),
      d(ray.direction[0], ray.direction[1], ray.direction[2]);
  const glm::uvec3& v = scene.triangles[hit.triangle];
  const glm::dvec3 a = glm::dvec3(scene.positions[v.x]) - o, b = glm::dvec3(scene.positions[v.y]) - o,
                   c = glm::dvec3(scene.positions[v.z]) - o;
  *reach = std::max({glm::length(a), glm::length(b), glm::length(c)});
  return std::abs(glm::dot(double(hit.t) * d - a, glm::normalize(glm::cross(b - a, c - a))));
}

/// Adds errors of hits: distances from the plane of the triangle, and decisions where the exact hit is well
/// inside.
void judgeHits(const char* stress, const Soup& soup, const std::vector<Ray>& rays,
               const std::vector<Hit>& hits, double margin, double bound, Trials& trials) {
  Differences differences;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    const auto exact = reference::closestHit(soup.scene, {ray.origin[0], ray.origin[1], ray.origin[2]},
                                             {ray.direction[0], ray.direction[1], ray.direction[2]}, 3.4e38,
                                             PRELIGHT_NO_TRIANGLE);
    const bool hit = hits[i].triangle != PRELIGHT_NO_TRIANGLE;
    const bool certain = exact && std::min({exact->u, exact->v, 1.0 - exact->u - exact->v}) > margin;
    if (certain)
      differences.decide(hit && (hits[i].triangle == exact->triangle || hits[i].t < exact->t * (1.0 + 1e-5)));
    if (!hit) continue;
    double reach = 0.0;
    const double off = offPlane(soup.scene, ray, hits[i], &reach);
    differences.add(off, 0.0, reach);
    differences.add(hits[i].u, std::clamp(double(hits[i].u), 0.0, 1.0), 1.0);
    differences.add(hits[i].v, std::clamp(double(hits[i].v), 0.0, 1.0), 1.0);
  }
  trials.record(stress, differences, bound);
}

struct RaySetting {
  const char* stress;
  double size;
  double away;  ///< distance from the origin, in sizes
  bool slim;
  Aim aim;
  double margin;
};

constexpr std::array<RaySetting, 9> settings = {
    {{"triangles of 1 m", 1.0, 0.0, false, Aim::Straight, 1e-4},
     {"of 1e-6 m", 1e-6, 0.0, false, Aim::Straight, 1e-4},
     {"of 1e6 m", 1e6, 0.0, false, Aim::Straight, 1e-4},
     {"1000 sizes from zero", 1.0, 1000.0, false, Aim::Straight, 1e-2},
     {"slivers of 1000 : 1", 1.0, 0.0, true, Aim::Straight, 1e-2},
     {"grazing rays", 1.0, 0.0, false, Aim::Grazing, 1e-2},
     {"directions of 1e18", 1.0, 0.0, false, Aim::Long, 1e-4},
     {"directions of 1e-22", 1.0, 0.0, false, Aim::Short, 1e-4},
     {"axes with denormal rests", 1.0, 0.0, false, Aim::Axis, 1e-4}}};

/// Returns the bound of a setting. Errors of barycentric weights grow with the aspect ratio of a triangle.
double boundOf(const RaySetting& s) { return (s.slim ? 1000.0 : 1.0) * 32.0 * unitRoundoff; }

/// Measures rays and triangles with NaN: hits must be finite.
void traceNoNumbers(const char* stress, BvhLayout layout, Trials& trials) {
  Soup soup = soupOf(1.0, glm::dvec3(0.0), false);
  std::vector<Ray> rays = raysAt(soup, Aim::Straight, 400);
  const std::array<float, 6> strange = {NAN, INFINITY, -INFINITY, 3e38f, 0.0f, 1e-45f};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    float* places[7] = {rays[i].origin,        rays[i].origin + 1,    rays[i].origin + 2, rays[i].direction,
                        rays[i].direction + 1, rays[i].direction + 2, &rays[i].tMax};
    *places[i % 7] = strange[i / 7 % 6];
  }
  Tracer tracer(soup.scene, trials.device(), layout);
  Differences differences;
  for (const Hit& hit : tracer.traceClosest(rays))
    for (const float value : {hit.t, hit.u, hit.v}) differences.add(value, value);
  trials.record(stress, differences, 0.0);
}

/// Measures rays towards a light through panes, each of which absorbs a quarter.
void tracePastPanes(double size, int panes, BvhLayout layout, bool moving, Trials& trials) {
  Material pane = matte(0.5);
  pane.baseColor.a = 0.25f;
  pane.alphaMode = AlphaMode::Blend;
  std::vector<Sheet> sheets;
  for (int i = 0; i < panes; ++i) sheets.push_back({0.1 * size * i, pane, i % 2 == 1});
  const CompiledScene scene = stackScene(size, sheets);
  Tracer tracer(scene, trials.device(), layout);
  if (moving) tracer.separate(scene, std::vector<std::uint32_t>{0, 1});
  Random random(91);
  std::vector<Ray> rays;
  for (int i = 0; i < 64; ++i) {
    const glm::dvec3 o = size * glm::dvec3(random.between(-0.5, 0.5), 2.0, random.between(-0.5, 0.5));
    const glm::vec3 origin(o - scene.origin), way(0.0f, -1.0f, 0.0f);
    rays.push_back({{origin.x, origin.y, origin.z}, PRELIGHT_NO_TRIANGLE, {way.x, way.y, way.z}, 1e30f});
  }
  Differences differences;
  for (const Hit& hit : tracer.traceShadows(rays)) {
    const bool arrives = hit.triangle == PRELIGHT_NO_TRIANGLE || hit.triangle == PRELIGHT_PAST_PANES;
    for (const float share : {hit.t, hit.u, hit.v})
      differences.add(arrives ? share : 0.0f, std::pow(0.75, panes));
  }
  trials.record("panes on the way to a light", differences, 8.0 * (panes + 1) * unitRoundoff,
                {"panes", double(panes)});
}

void traceLayout(BvhLayout layout, const char* name, Trials& trials) {
  for (const RaySetting& s : settings) {
    const Soup soup = soupOf(s.size, s.away * s.size * glm::dvec3(0.6, -0.5, 0.7), s.slim);
    const std::vector<Ray> rays = raysAt(soup, s.aim, trials.options().rays);
    Tracer tracer(soup.scene, trials.device(), layout);
    judgeHits((std::string(s.stress) + ", " + name).c_str(), soup, rays, tracer.traceClosest(rays), s.margin,
              boundOf(s), trials);
  }
  traceNoNumbers((std::string("NaN, infinity, 3e38, 0 and denormal, ") + name).c_str(), layout, trials);
}

}  // namespace

void runGenerateRays(Trials& trials) {
  Random random(4);
  std::vector<glm::vec3> anywhere, poles;
  for (int i = 0; i < 60; ++i) anywhere.emplace_back(random.direction());
  for (const float z : {1.0f, -1.0f, -0.99999994f, 0.99999994f})
    for (const float x : {0.0f, -0.0f, 1e-20f, 1e-40f, 3e-4f}) poles.emplace_back(x, 0.0f, z);
  for (const float z : {0.0f, -0.0f, 1e-40f, -1e-7f}) poles.emplace_back(0.6f, 0.8f, z);
  for (const std::uint32_t count : {8u, 64u, 256u}) {
    generate("normals anywhere", receiversAt(anywhere, 1.0, false, count), count, trials);
    generate("normals along axes and next to them", receiversAt(poles, 1e-6, false, count), count, trials);
    generate("the end of the sequence, 2^32", receiversAt(anywhere, 1e6, true, count), count, trials);
  }
}

/// Returns the scene as an instance that is twice as large as its shape and turned by a right angle, both
/// exact in float.
CompiledScene asInstance(CompiledScene scene) {
  CompiledShape shape{0, scene.triangleCount(), 0, scene.vertexCount(), scene.positions};
  for (glm::vec3& p : shape.positions) p = 0.5f * glm::vec3(p.y, -p.x, p.z);
  glm::dmat4 toWorld(0.0);
  toWorld[0] = {0.0, 2.0, 0.0, 0.0};
  toWorld[1] = {-2.0, 0.0, 0.0, 0.0};
  toWorld[2] = {0.0, 0.0, 2.0, 0.0};
  toWorld[3] = {0.0, 0.0, 0.0, 1.0};
  scene.shapes = {shape};
  scene.instances = {{0, 0, 0, toWorld}};
  return scene;
}

void runTracing(Trials& trials) {
  traceLayout(BvhLayout::Wide, "wide tree", trials);
  traceLayout(BvhLayout::Narrow, "narrow tree", trials);
  for (const double size : {1e-6, 1.0, 1e6})
    for (const BvhLayout layout : {BvhLayout::Wide, BvhLayout::Narrow})
      for (const int panes : {1, 2, 16})
        for (const bool moving : {false, true}) tracePastPanes(size, panes, layout, moving, trials);
  for (const RaySetting& s : settings) {
    const Soup soup = soupOf(s.size, s.away * s.size * glm::dvec3(0.6, -0.5, 0.7), s.slim);
    const std::vector<Ray> rays = raysAt(soup, s.aim, trials.options().rays);
    Tracer tracer(soup.scene, trials.device());
    std::vector<std::uint32_t> moving;
    for (std::uint32_t t = 0; t < 60; t += 2) moving.push_back(t);
    tracer.separate(soup.scene, moving);
    judgeHits((std::string(s.stress) + ", two trees").c_str(), soup, rays, tracer.traceClosest(rays),
              s.margin, boundOf(s), trials);
    const CompiledScene scene = asInstance(soup.scene);
    for (const BvhLayout layout : {BvhLayout::Wide, BvhLayout::Narrow}) {
      Tracer instanced(scene, trials.device(), layout, BuildQuality::High, TreeLevels::Two);
      judgeHits((std::string(s.stress) + ", an instance").c_str(), soup, rays, instanced.traceClosest(rays),
                s.margin, boundOf(s), trials);
    }
  }
}

namespace {

using device::CastParameters;
using device::Hit;
using device::Ray;
using device::Receiver;
using device::SpecularEnd;

constexpr std::uint32_t walkReceivers = 16, walkRays = 64;
constexpr double roundingsAStep = 32.0 * unitRoundoff;  // exponentials, quotients and their products

/// Returns a ball that scatters all light and absorbs none, with a radius of `depth` mean free paths.
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

/// Measures rays from the middle, whose weights must stay the same up to the surface.
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

/// Measures the light that the ball's inside emits, seen from its middle through any depth.
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
