#include "occluders/carried_record.h"

#include <algorithm>
#include <cmath>

#include "occluders/occluder_record.h"

namespace prelight {

namespace {

constexpr double nearestSine = 0.98;  // upper bound for balls that a vertex touches or lies in
constexpr double mostOfBall = 1.5;    // a form factor may exceed the ball's by this factor
// Ratio of the ball's form factors, before over after, below which the record before is useless.
constexpr double hiddenShare = 0.1;
constexpr double shareOfBall = 0.8;  // form factor over the ball's, for bodies that were not seen before
// In radii: how far the centroid of the visible part lies in front of the centre.
constexpr double centroidOfDisk = 0.66;
constexpr double leastRise = 0.05;       // least cosine of a direction with the normal
constexpr double cosinePerSpread = 0.5;  // for a ball: 1 - r over 1 - cos of its angular radius

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// A body's ball as seen from a place.
struct BallView {
  glm::dvec3 direction{0.0};
  double distance = 0.0;
  double sine = 0.0;
  double formFactor = 0.0;

  BallView(const OccluderView& view, const glm::dvec3& centre, double radius) {
    const glm::dvec3 path = centre - view.position;
    distance = glm::length(path);
    direction = distance > 0.0 ? path / distance : view.normal;
    sine = std::min(nearestSine, radius / std::max(distance, 1e-300));
    formFactor = ballFormFactor(glm::dot(view.normal, direction), sine);
  }

  /// Returns 1 - cos of the angular radius.
  double spread() const { return 1.0 - std::sqrt(1.0 - sine * sine); }
};

/// Returns the smallest rotation from one unit vector to another.
glm::dmat3 rotationBetween(const glm::dvec3& from, const glm::dvec3& to) {
  const double cosine = glm::dot(from, to);
  if (cosine < -1.0 + 1e-9) {  // half a turn about any perpendicular axis
    const glm::dvec3 other = std::abs(from.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 axis = glm::normalize(glm::cross(from, other));
    return 2.0 * glm::outerProduct(axis, axis) - glm::dmat3(1.0);
  }
  const glm::dvec3 k = glm::cross(from, to);
  // Matrix of the cross product with k.
  const glm::dmat3 cross(0.0, k.z, -k.y, -k.z, 0.0, k.x, k.y, -k.x, 0.0);
  return cosine * glm::dmat3(1.0) + cross + glm::outerProduct(k, k) / (1.0 + cosine);
}

/// Returns a unit direction raised above the horizon, which the ball's centre may be below.
glm::dvec3 risen(const glm::dvec3& direction, const glm::dvec3& normal) {
  const double rise = glm::dot(direction, normal);
  if (rise >= leastRise) return direction;
  return glm::normalize(direction + (leastRise - rise) * normal);
}

/// Change of a view between the carried vertex and the vertex that sees the occluder now.
struct Change {
  glm::dmat3 turn{1.0};
  glm::dvec3 centre{0.0};  ///< positions turn about it
  glm::dvec3 shift{0.0};   ///< shift of positions that move with the vertex
  double scale = 1.0;      ///< factor of the form factor
  double spread = 1.0;     ///< factor of 1 - r
  double share = 1.0;      ///< weight of turning, as opposed to shifting
  glm::dvec3 toward{0.0};  ///< unit, towards the ball's centre now
  double narrowing = 1.0;  ///< factor, at most 1, of the angle between the mean direction and that centre

  glm::dvec3 position(const glm::dvec3& p) const {
    return glm::mix(p + shift, centre + turn * (p - centre), share);
  }
};

/// Computes the change; `body` is at its present place.
Change changeOf(const OccluderView& carried, const OccluderView& to, const OccluderBody& body,
                double formFactor) {
  const BallView before(carried, body.centre, body.radius), after(to, body.centre, body.radius);
  Change change;
  change.shift = to.position - carried.position;
  const double reach = std::max(body.reach, 1e-300);
  change.share = std::max(smooth(0.35, 0.75, glm::length(change.shift) / reach),
                          smooth(0.7, 1.0, before.distance / reach));
  double scaled = formFactor;
  if (before.formFactor > hiddenShare * after.formFactor)
    scaled = std::min(formFactor / before.formFactor * after.formFactor,
                      std::max(formFactor, mostOfBall * after.formFactor));
  else
    scaled = shareOfBall * after.formFactor;
  change.scale = glm::mix(1.0, scaled / formFactor, change.share);
  change.spread = glm::mix(1.0, after.spread() / std::max(before.spread(), 1e-300), change.share);
  const glm::dvec3 toward = glm::mix(before.direction, after.direction, change.share);
  const double length = glm::length(toward);
  if (length > 1e-6) change.turn = rotationBetween(before.direction, toward / length);
  change.toward = length > 1e-6 ? toward / length : before.direction;
  change.narrowing = std::min(1.0, change.spread);
  change.centre = body.centre;
  return change;
}

glm::vec4 with(const glm::dvec3& xyz, double w) { return {glm::vec3(xyz), static_cast<float>(w)}; }

/// Returns the form-factor weighted sum of directions after a change.
glm::vec4 changedOcclusion(const glm::vec4& occlusion, const glm::dvec3& turned, const Change& change,
                           const glm::dvec3& normal) {
  const double formFactor = std::min(1.0, change.scale * double(occlusion.w));
  const double length = glm::length(turned);
  if (!(length > 0.0)) return with(glm::dvec3(0.0), formFactor);
  const double resultant = std::min(1.0, length / double(occlusion.w));
  const double changed =
      std::clamp(1.0 - (1.0 - resultant) * change.spread, std::min(resultant, 2.0 / 3.0), 1.0);
  const glm::dvec3 direction = glm::mix(change.toward, turned / length, change.narrowing);
  if (!(glm::length(direction) > 1e-6)) return with(glm::dvec3(0.0), formFactor);
  return with(changed * formFactor * risen(glm::normalize(direction), normal), formFactor);
}

}  // namespace

OccluderBody movedBody(const OccluderBody& body, const RigidMotion& motion) {
  OccluderBody moved = body;
  moved.centre = motion.point(body.centre);
  return moved;
}

bool comesIntoView(const OccluderView& from, const RigidMotion& motion, const OccluderBody& body,
                   const OccluderView& to) {
  const glm::dvec3 centre = motion.point(body.centre);
  const OccluderView carried{motion.point(from.position), motion.direction(from.normal)};
  return BallView(carried, centre, body.radius).formFactor <
         hiddenShare * BallView(to, centre, body.radius).formFactor;
}

void carryRecord(std::span<const OccluderVector> stored, std::span<const glm::vec4> record,
                 const OccluderView& from, const RigidMotion& motion, const OccluderBody& body,
                 const OccluderView& to, std::span<glm::vec4> carried) {
  const OccluderView alongside{motion.point(from.position), motion.direction(from.normal)};
  const auto occlusion = std::find(stored.begin(), stored.end(), OccluderVector::Occlusion) - stored.begin();
  const double formFactor = record[static_cast<std::size_t>(occlusion)].w;
  std::copy(record.begin(), record.end(), carried.begin());
  if (!(formFactor > 0.0)) return;
  const Change change = changeOf(alongside, to, movedBody(body, motion), formFactor);
  for (std::size_t s = 0; s < stored.size(); ++s) {
    const glm::dvec3 xyz(record[s]);
    if (stored[s] == OccluderVector::Position) {
      const glm::dvec3 before = motion.point(xyz), after = change.position(before);
      const double path = glm::length(before - alongside.position);
      const double excess = path > 0.0 ? std::clamp(double(record[s].w) / path, 1.0, 3.0) : 1.0;
      carried[s] = with(after, glm::length(after - to.position) * glm::mix(1.0, excess, change.narrowing));
    } else if (stored[s] == OccluderVector::Occlusion) {
      carried[s] = changedOcclusion(record[s], change.turn * motion.direction(xyz), change, to.normal);
    } else if (isSum(stored[s])) {
      carried[s] =
          with(change.scale * (change.turn * motion.direction(xyz)), change.scale * double(record[s].w));
    }
  }
}

void ballRecord(std::span<const OccluderVector> stored, const OccluderBody& body, const OccluderView& to,
                std::span<glm::vec4> record) {
  const BallView ball(to, body.centre, body.radius);
  const double formFactor = shareOfBall * ball.formFactor;
  const double weight = formFactor * body.accessibility;
  const glm::dvec3 seen =
      body.centre - centroidOfDisk * std::min(body.radius, ball.distance) * ball.direction;
  for (std::size_t s = 0; s < stored.size(); ++s) {
    switch (stored[s]) {
      case OccluderVector::Position:
        record[s] = with(seen, glm::length(seen - to.position));
        break;
      case OccluderVector::Occlusion:
        record[s] =
            with((1.0 - cosinePerSpread * ball.spread()) * formFactor * risen(ball.direction, to.normal),
                 formFactor);
        break;
      case OccluderVector::DiffuseNormal:
        record[s] = with(-centroidOfDisk * weight * ball.direction, weight);
        break;
      case OccluderVector::DiffuseColor:
        record[s] = glm::vec4(body.color, 0.0f);
        break;
      case OccluderVector::Transmissive:
        record[s] = glm::vec4(body.transmissive, 0.0f);
        break;
      case OccluderVector::Caustic:
      case OccluderVector::SpecularNormal:
      case OccluderVector::SpecularColor:
        record[s] = glm::vec4(0.0f);
        break;
    }
  }
}

void scaleRecord(std::span<const OccluderVector> stored, double factor, std::span<glm::vec4> record) {
  for (std::size_t s = 0; s < stored.size(); ++s)
    if (isSum(stored[s])) record[s] = glm::vec4(factor * glm::dvec4(record[s]));
}

}  // namespace prelight
