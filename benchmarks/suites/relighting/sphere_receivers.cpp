#include "benchmarks/suites/relighting/sphere_receivers.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "base/parallel.h"
#include "basis/haar.h"

namespace prelight::benchmarks {

namespace {

constexpr double halfPlane = 3.0;
const glm::vec3 planeAlbedo(0.5f);

/// Returns a uniform number in [0, 1), the same with every standard library.
double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

}  // namespace

SphereReceivers::SphereReceivers(int count, int balls, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (int i = 0; i < balls; ++i) {
    const double radius = 0.2 + 0.4 * uniform(random);
    const double x = 4.0 * uniform(random) - 2.0;
    const double z = 4.0 * uniform(random) - 2.0;
    const double y = radius * (1.0 + uniform(random));
    glm::vec3 albedo;
    for (int c = 0; c < 3; ++c) albedo[c] = static_cast<float>(0.2 + 0.6 * uniform(random));
    balls_.push_back({{x, y, z}, radius, albedo});
  }
  while (places_.size() < static_cast<std::size_t>(count)) {
    Place place{{4.0 * uniform(random) - 2.0, 0.0, 4.0 * uniform(random) - 2.0}, {0.0, 1.0, 0.0}};
    if (places_.size() % 2 == 1) {
      const Ball& ball = balls_[random() % balls_.size()];
      const double y = 2.0 * uniform(random) - 1.0;
      const double azimuth = 2.0 * std::numbers::pi * uniform(random);
      const double across = std::sqrt(1.0 - y * y);
      place.normal = {across * std::cos(azimuth), y, across * std::sin(azimuth)};
      place.point = ball.centre + (ball.radius + 1e-6) * place.normal;
    }
    bool inside = place.point.y < 0.0;
    for (const Ball& ball : balls_) inside = inside || glm::distance(place.point, ball.centre) < ball.radius;
    if (!inside) places_.push_back(place);
  }
}

bool SphereReceivers::hit(std::size_t receiver, const glm::dvec3& direction, Hit& nearest) const {
  const glm::dvec3& origin = places_[receiver].point;
  nearest = {std::numeric_limits<double>::infinity(), 0};
  for (std::size_t b = 0; b < balls_.size(); ++b) {
    const glm::dvec3 to = balls_[b].centre - origin;
    const double along = glm::dot(to, direction);
    const double under = balls_[b].radius * balls_[b].radius - (glm::dot(to, to) - along * along);
    if (along <= 0.0 || under <= 0.0) continue;
    const double distance = along - std::sqrt(under);
    if (distance > 1e-5 && distance < nearest.distance) nearest = {distance, b};
  }
  if (direction.y < 0.0 && origin.y > 1e-5) {
    const double distance = -origin.y / direction.y;
    const glm::dvec3 point = origin + distance * direction;
    const bool onPlane = std::abs(point.x) < halfPlane && std::abs(point.z) < halfPlane;
    if (onPlane && distance < nearest.distance) nearest = {distance, balls_.size()};
  }
  return std::isfinite(nearest.distance);
}

bool SphereReceivers::seesSky(std::size_t receiver, const glm::dvec3& direction) const {
  Hit nearest{};
  return !hit(receiver, direction, nearest);
}

std::vector<float> SphereReceivers::texelTransfer(std::size_t receiver, const CubeTexels& texels) const {
  std::vector<float> values(texels.count());
  texels.open(normal(receiver), std::span<float>(values));
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    if (values[i] > 0.0f && !seesSky(receiver, cubeTexelDirection(i, texels.faceSize()))) values[i] = 0.0f;
  }
  return values;
}

HaarTransfer SphereReceivers::transfer(const CubeTexels& texels, double relativeError) const {
  std::vector<haar::SparseRow> rows(count());
  parallelRanges(count(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      std::vector<float> values = texelTransfer(v, texels);
      haar::forward(std::span<float>(values), texels.faceSize());
      rows[v] = haar::keepError(values, relativeError);
    }
  });
  HaarTransfer transfer{.faceSize = texels.faceSize(),
                        .channels = 1,
                        .bounces = 0,
                        .offsets = {0},
                        .indices = {},
                        .values = {}};
  for (const haar::SparseRow& row : rows) haar::appendRow(transfer, row);
  return transfer;
}

std::uint32_t SphereReceivers::nearestReceiver(const glm::dvec3& point, const glm::dvec3& normal) const {
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t v = 0; v < places_.size(); ++v) {
    const glm::dvec3 apart = places_[v].point - point;
    const double turned = 1.0 - glm::dot(places_[v].normal, normal);
    const double cost = glm::dot(apart, apart) + turned * turned;
    if (cost < least) {
      least = cost;
      best = v;
    }
  }
  return best;
}

std::vector<std::vector<haar::Link>> SphereReceivers::links(const CubeTexels& texels) const {
  std::vector<std::vector<haar::Link>> all(count());
  parallelRanges(count(), 8, [&](std::size_t begin, std::size_t end) {
    std::vector<float> open(texels.count());
    for (std::size_t v = begin; v < end; ++v) {
      texels.open(normal(v), std::span<float>(open));
      std::vector<glm::vec3> weights(count(), glm::vec3(0.0f));
      for (std::uint32_t i = 0; i < open.size(); ++i) {
        const glm::dvec3 direction = cubeTexelDirection(i, texels.faceSize());
        Hit nearest{};
        if (open[i] <= 0.0f || !hit(v, direction, nearest)) continue;
        const glm::dvec3 point = places_[v].point + nearest.distance * direction;
        const bool plane = nearest.thing == balls_.size();
        const glm::dvec3 facing =
            plane ? glm::dvec3(0, 1, 0) : glm::normalize(point - balls_[nearest.thing].centre);
        weights[nearestReceiver(point, facing)] +=
            open[i] * (plane ? planeAlbedo : balls_[nearest.thing].albedo);
      }
      for (std::uint32_t s = 0; s < weights.size(); ++s) {
        if (weights[s] != glm::vec3(0.0f)) all[v].push_back({s, weights[s]});
      }
    }
  });
  return all;
}

}  // namespace prelight::benchmarks
