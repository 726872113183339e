#include "relight/object_occluder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "basis/cube_map.h"
#include "basis/sh_zonal.h"
#include "occluders/occluder_record.h"
#include "occluders/rigid_motion.h"

namespace prelight {

namespace {

using namespace device;

constexpr int directionsASide = 8;    ///< per side of the cube map of directions
constexpr double viewDistance = 3.0;  ///< distance of views, in radii of the object
constexpr std::uint32_t raysAView = 256;
constexpr double nearestView = 1.001;  ///< least distance from the centre, in radii of the ball
constexpr double softness = 0.15;      ///< width of shadow edges, in angular radii of the ball
constexpr std::size_t placesOfEmitters = 16;
constexpr std::size_t occludedGrain = 256;

/// Returns a ball that hides as much as the rays' hits, centred on them.
ObjectBall ballOfHits(const ObjectBall& around, const glm::dvec3& from, std::span<const Ray> rays,
                      std::span<const Hit> hits) {
  glm::dvec3 sum(0.0);
  double met = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].triangle == PRELIGHT_NO_TRIANGLE) continue;
    sum += glm::normalize(wayOf(rays[i]));
    met += 1.0;
  }
  if (!(met > 0.0)) return {around.centre, 0.0};
  const ObjectCone cone = coneTowards(around, from);
  const double share = met / static_cast<double>(rays.size());
  const double cosine = 1.0 - share * (1.0 - cone.cosine);
  const glm::dvec3 axis = glm::normalize(sum);
  const double distance = glm::distance(around.centre, from) / glm::dot(axis, cone.axis);
  return {from + distance * axis, distance * std::sqrt(std::max(0.0, 1.0 - cosine * cosine))};
}

}  // namespace

ObjectOccluder::ObjectOccluder(const CompiledScene& scene, const VertexRange& range, const Tracer& whole)
    : range_(range),
      rest_(scene.positions.begin() + range.firstVertex,
            scene.positions.begin() + range.firstVertex + range.vertexCount),
      around_(ballAroundObject(scene, range)) {
  Tracer alone(whole, scene, trianglesOf(range));
  std::vector<Ray> rays;
  std::vector<glm::dvec3> views;
  for (std::uint32_t t = 0; t < cubeTexelCount(directionsASide); ++t) {
    views.push_back(around_.centre + viewDistance * around_.radius * cubeTexelDirection(t, directionsASide));
    const std::vector<Ray> some = raysAtBall(around_, views.back(), raysAView, t);
    rays.insert(rays.end(), some.begin(), some.end());
  }
  const std::vector<Hit> hits = alone.traceAny(std::span<const Ray>(rays));
  for (std::size_t t = 0; t < views.size(); ++t)
    balls_.push_back(ballOfHits(around_, views[t], std::span(rays).subspan(t * raysAView, raysAView),
                                std::span(hits).subspan(t * raysAView, raysAView)));
}

void ObjectOccluder::follow(const CompiledScene& scene) {
  motion_ =
      fitMotion(rest_, std::span(scene.positions).subspan(range_.firstVertex, range_.vertexCount)).motion;
}

ObjectBall ObjectOccluder::seenFrom(const glm::dvec3& point) const {
  const glm::dvec3 way = motion_.pointBefore(point) - around_.centre;
  if (!(glm::dot(way, way) > 0.0)) return {motion_.point(around_.centre), around_.radius};
  const ObjectBall& ball = balls_[cubeTexel(way, directionsASide)];
  return {motion_.point(ball.centre), ball.radius};
}

namespace {

glm::dvec3 middleOf(const CompiledScene& scene, const LightTables& tables, std::size_t emitter) {
  const glm::uvec3& v = scene.triangles[tables.emitters[emitter]];
  const glm::vec3 &a = scene.positions[v.x], &b = scene.positions[v.y], &c = scene.positions[v.z];
  if (tables.emitterParts.empty()) return glm::dvec3(a + b + c) / 3.0;
  const glm::vec4& part = tables.emitterParts[emitter];
  const float third = part.z / 3.0f;
  return glm::dvec3(a + (part.x + third) * (b - a) + (part.y + third) * (c - a));
}

}  // namespace

LampPlaces placesOf(const CompiledScene& scene, const GroupedLights& lights) {
  LampPlaces places;
  places.ofGroup.resize(lights.groups.size());
  for (const LightRay& ray : lights.rays) {
    if (ray.light == PRELIGHT_NO_EMITTER) continue;
    const PunctualLight& light = lights.tables.punctual[ray.light];
    const bool isFar = light.kind == PRELIGHT_DIRECTIONAL_LIGHT;
    const float* at = isFar ? light.direction : light.position;
    const glm::dvec3 place(at[0], at[1], at[2]);
    places.ofGroup[ray.group].push_back({isFar ? -place : place, isFar, 1.0});
  }
  std::vector<std::size_t> seen(lights.groups.size(), 0), all(lights.groups.size(), 0);
  for (const GroupEmitter& emitter : lights.emitters) ++all[emitter.group];
  for (std::size_t e = 0; e < lights.emitters.size(); ++e) {
    const std::size_t group = lights.emitters[e].group;
    const std::size_t step = std::max<std::size_t>(1, all[group] / placesOfEmitters);
    if (seen[group]++ % step != step / 2) continue;
    places.ofGroup[group].push_back({middleOf(scene, lights.tables, e), false, 1.0});
  }
  for (std::vector<LampPlaces::Place>& group : places.ofGroup)
    for (LampPlaces::Place& place : group) place.weight = 1.0 / static_cast<double>(group.size());
  return places;
}

double lampPast(const ObjectBall& ball, const glm::dvec3& point, const LampPlaces::Place& lamp) {
  const glm::dvec3 toBall = ball.centre - point, toLamp = lamp.isFar ? lamp.at : lamp.at - point;
  const double distance = glm::length(toBall), way = glm::length(toLamp);
  if (!(ball.radius > 0.0) || !(distance > 0.0) || !(way > 0.0)) return 1.0;
  if (!lamp.isFar && way < distance) return 1.0;
  const double between = std::acos(std::clamp(glm::dot(toBall, toLamp) / (distance * way), -1.0, 1.0));
  // Within the ball: half of all directions.
  const double angle = std::asin(std::min(1.0, ball.radius / distance));
  const double t = std::clamp(0.5 + 0.5 * (between - angle) / (softness * angle), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

namespace {

/// Adds the light that one object hides from a vertex.
void addHidden(const ObjectBall& ball, const glm::dvec3& from, const glm::dvec3& normal, const Hit& behind,
               int order, std::uint32_t vertex, ObjectShadow& shadow) {
  const glm::dvec3 way = ball.centre - from;
  const double distance = std::max(glm::length(way), nearestView * ball.radius);
  const bool isSky = behind.triangle == PRELIGHT_NO_TRIANGLE;
  // The object is hidden; rays are as long as the distance to its centre.
  if (!isSky && double{behind.t} < 1.0) return;
  const glm::dvec3 axis = glm::normalize(way);
  const double factor = ballFormFactor(glm::dot(axis, normal), ball.radius / distance);
  if (factor < leastHidden) return;
  shadow.hidden[vertex] += static_cast<float>(factor);
  if (!isSky) {
    shadow.surfaces[vertex] += static_cast<float>(factor);
    return;
  }
  const auto bands = static_cast<std::size_t>(order * order);
  std::vector<double> zonal(static_cast<std::size_t>(order)), values(bands);
  const double angle = std::asin(ball.radius / distance);
  sh::capZonal(angle, zonal);
  sh::turnZonal(zonal, axis, values);
  const double size = 2.0 * std::numbers::pi * (1.0 - std::cos(angle));
  for (std::size_t i = 0; i < bands; ++i)
    shadow.sky[vertex * bands + i] += static_cast<float>(factor * values[i] / size);
}

}  // namespace

ObjectShadow shadowByOccluders(const CompiledScene& scene, const VertexRange& baked,
                               std::span<const ObjectOccluder> objects, Tracer& walls, int order) {
  const std::size_t vertices = baked.vertexCount;
  ObjectShadow shadow{std::vector<float>(vertices),
                      std::vector<float>(vertices * static_cast<std::size_t>(order * order)),
                      std::vector<float>(vertices)};
  for (const ObjectOccluder& object : objects) {
    std::vector<std::uint32_t> seeing;
    std::vector<ObjectBall> balls;
    std::vector<Ray> rays;
    for (std::uint32_t v = 0; v < vertices; ++v) {
      const ObjectBall ball = object.seenFrom(glm::dvec3(scene.positions[v]));
      const glm::dvec3 normal(scene.normals[v]);
      const glm::dvec3 from = glm::dvec3(scene.positions[v]) + rayLift * ball.radius * normal;
      const glm::dvec3 way = ball.centre - from;
      const double sine = ball.radius / std::max(glm::length(way), nearestView * ball.radius);
      if (!(ball.radius > 0.0) || sine * sine < leastHidden || glm::dot(way, normal) < -ball.radius) continue;
      seeing.push_back(v);
      balls.push_back(ball);
      rays.push_back(rayAlong(from, way));
    }
    const std::vector<Hit> behind = walls.traceClosest(std::span<const Ray>(rays));
    parallelRanges(seeing.size(), occludedGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        addHidden(balls[i], glm::dvec3(scene.positions[seeing[i]]), glm::dvec3(scene.normals[seeing[i]]),
                  behind[i], order, seeing[i], shadow);
    });
  }
  return shadow;
}

std::vector<float> lampsPastOccluders(const CompiledScene& scene, const VertexRange& baked,
                                      std::span<const ObjectOccluder> objects, const LampPlaces& lamps,
                                      std::span<const float> unhidden) {
  std::vector<float> values(unhidden.begin(), unhidden.end());
  const std::size_t groups = lamps.ofGroup.size();
  const auto shade = [&](std::size_t v) {
    const glm::dvec3 point(scene.positions[v]);
    for (const ObjectOccluder& object : objects) {
      const ObjectBall ball = object.seenFrom(point);
      for (std::size_t g = 0; g < groups; ++g) {
        double share = 0.0;
        for (const LampPlaces::Place& lamp : lamps.ofGroup[g])
          share += lamp.weight * lampPast(ball, point, lamp);
        for (std::size_t c = 0; c < 3; ++c) values[(3 * v + c) * groups + g] *= static_cast<float>(share);
      }
    }
  };
  parallelRanges(baked.vertexCount, occludedGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) shade(v);
  });
  return values;
}

}  // namespace prelight
