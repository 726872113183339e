#include "prelight/scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace prelight {

namespace {

glm::dvec4 unitOrNone(const glm::dvec4& rotation) {
  const double length = glm::length(rotation);
  return length > 0.0 ? rotation / length : glm::dvec4(0.0, 0.0, 0.0, 1.0);
}

/// Interpolates two rotations spherically along the shorter arc (glTF 2.0 appendix C.4). Nearly equal
/// rotations have no angle to divide by; linear interpolation is as good then.
glm::dvec4 slerp(const glm::dvec4& from, glm::dvec4 to, double t) {
  double cosine = glm::dot(from, to);
  if (cosine < 0.0) {
    to = -to;
    cosine = -cosine;
  }
  constexpr double nearlyEqual = 1.0 - 1e-12;
  if (cosine > nearlyEqual) return unitOrNone(glm::mix(from, to, t));
  const double angle = std::acos(cosine);
  return (std::sin((1.0 - t) * angle) * from + std::sin(t * angle) * to) / std::sin(angle);
}

/// Evaluates the Hermite spline of glTF 2.0 appendix C.5; `interval` seconds scale the tangents. at(key,
/// part) returns a number or a vector: part 0 the in-tangent, part 1 the value, part 2 the out-tangent.
template <class At>
auto hermite(At at, std::size_t key, double t, double interval) {
  const double t2 = t * t, t3 = t2 * t;
  return (2.0 * t3 - 3.0 * t2 + 1.0) * at(key, 1) + interval * (t3 - 2.0 * t2 + t) * at(key, 2) +
         (-2.0 * t3 + 3.0 * t2) * at(key + 1, 1) + interval * (t3 - t2) * at(key + 1, 0);
}

glm::dvec4 valueOfKey(const AnimationSampler& sampler, std::size_t key) {
  return {sampler.values[sampler.interpolation == Interpolation::CubicSpline ? 3 * key + 1 : key]};
}

glm::dvec4 between(const AnimationSampler& sampler, AnimatedPath path, std::size_t key, double seconds) {
  const double start = sampler.times[key], interval = sampler.times[key + 1] - start;
  const double t = (seconds - start) / interval;
  switch (sampler.interpolation) {
    case Interpolation::Step:
      return valueOfKey(sampler, key);
    case Interpolation::CubicSpline:
      return hermite(
          [&](std::size_t k, std::size_t part) { return glm::dvec4(sampler.values[3 * k + part]); }, key, t,
          interval);
    case Interpolation::Linear:
      break;
  }
  const glm::dvec4 from = valueOfKey(sampler, key), to = valueOfKey(sampler, key + 1);
  return path == AnimatedPath::Rotation ? slerp(unitOrNone(from), unitOrNone(to), t) : glm::mix(from, to, t);
}

std::vector<float>::const_iterator firstKeyAfter(const AnimationSampler& sampler, double seconds) {
  return std::upper_bound(sampler.times.begin(), sampler.times.end(), seconds,
                          [](double s, float time) { return s < double(time); });
}

/// Calls visit for the samplers of all channels. A sampler may be visited more than once.
template <class Visit>
void forEachSampler(const Animation& animation, Visit visit) {
  for (const AnimationChannel& channel : animation.channels) visit(animation.samplers[channel.sampler]);
  for (const PropertyChannel& channel : animation.properties) {
    visit(animation.samplers[channel.sampler]);
    if (channel.factorSampler >= 0)
      visit(animation.samplers[static_cast<std::size_t>(channel.factorSampler)]);
  }
}

}  // namespace

double Animation::startTime() const {
  std::optional<double> start;
  forEachSampler(*this, [&](const AnimationSampler& sampler) {
    start = std::min(start.value_or(sampler.times.front()), double(sampler.times.front()));
  });
  return std::max(start.value_or(0.0), 0.0);  // times before 0 cannot be requested
}

double Animation::endTime() const {
  double end = 0.0;
  forEachSampler(*this,
                 [&](const AnimationSampler& sampler) { end = std::max(end, double(sampler.times.back())); });
  return end;
}

glm::dvec4 sampleAt(const AnimationSampler& sampler, AnimatedPath path, double seconds) {
  const auto next = firstKeyAfter(sampler, seconds);
  glm::dvec4 value;
  if (next == sampler.times.begin()) {
    value = valueOfKey(sampler, 0);
  } else if (next == sampler.times.end()) {
    value = valueOfKey(sampler, sampler.times.size() - 1);
  } else {
    value = between(sampler, path, static_cast<std::size_t>(next - sampler.times.begin()) - 1, seconds);
  }
  return path == AnimatedPath::Rotation ? unitOrNone(value) : value;
}

std::vector<float> weightsAt(const AnimationSampler& sampler, double seconds) {
  const bool cubic = sampler.interpolation == Interpolation::CubicSpline;
  const auto at = [&](std::size_t key, std::size_t part, std::size_t target) {
    return double(sampler.weights[(cubic ? 3 * key + part : key) * sampler.targets + target]);
  };
  const auto next = firstKeyAfter(sampler, seconds);
  const std::size_t key =
      next == sampler.times.begin() ? 0 : static_cast<std::size_t>(next - sampler.times.begin()) - 1;
  const bool between = next != sampler.times.begin() && next != sampler.times.end() &&
                       sampler.interpolation != Interpolation::Step;
  const double interval = between ? double(sampler.times[key + 1]) - double(sampler.times[key]) : 1.0;
  const double t = (seconds - sampler.times[key]) / interval;
  std::vector<float> weights(sampler.targets);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto of = [&](std::size_t k, std::size_t part) { return at(k, part, i); };
    const double value = !between ? of(key, 1)
                         : cubic  ? hermite(of, key, t, interval)
                                  : (1.0 - t) * of(key, 1) + t * of(key + 1, 1);
    weights[i] = static_cast<float>(value);
  }
  return weights;
}

}  // namespace prelight
