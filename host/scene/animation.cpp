#include "prelight/scene.h"

#include <algorithm>
#include <cmath>

namespace prelight {

namespace {

glm::dvec4 unitOrNone(const glm::dvec4& rotation) {
  const double length = glm::length(rotation);
  return length > 0.0 ? rotation / length : glm::dvec4(0.0, 0.0, 0.0, 1.0);
}

/// Spherical linear interpolation the short way round, glTF 2.0 appendix C.4. Nearly equal rotations have no
/// angle to divide by; the straight line is as good then.
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

/// Hermite spline of glTF 2.0 appendix C.5; `interval` seconds scale the tangents.
glm::dvec4 hermite(const AnimationSampler& sampler, std::size_t key, double t, double interval) {
  const auto at = [&](std::size_t k, std::size_t part) { return glm::dvec4(sampler.values[3 * k + part]); };
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
      return hermite(sampler, key, t, interval);
    case Interpolation::Linear:
      break;
  }
  const glm::dvec4 from = valueOfKey(sampler, key), to = valueOfKey(sampler, key + 1);
  return path == AnimatedPath::Rotation ? slerp(unitOrNone(from), unitOrNone(to), t) : glm::mix(from, to, t);
}

}  // namespace

double Animation::startTime() const {
  double start = channels.empty() ? 0.0 : samplers[channels.front().sampler].times.front();
  for (const AnimationChannel& channel : channels)
    start = std::min(start, double(samplers[channel.sampler].times.front()));
  return start;
}

double Animation::endTime() const {
  double end = 0.0;
  for (const AnimationChannel& channel : channels)
    end = std::max(end, double(samplers[channel.sampler].times.back()));
  return end;
}

glm::dvec4 sampleAt(const AnimationSampler& sampler, AnimatedPath path, double seconds) {
  const auto next = std::upper_bound(sampler.times.begin(), sampler.times.end(), seconds,
                                     [](double s, float time) { return s < double(time); });
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

}  // namespace prelight
