#pragma once

#include <glm/glm.hpp>

namespace prelight {

/// Smallest angle, rad, from a light's middle to its rim at which its shadows have soft edges of their own.
constexpr double leastSoft = 0.014;

/// Slope that undoes some of the blur that a truncated basis leaves at edges of shadows.
constexpr double shadowSlope = 2.0;

/// A lamp as a receiver sees it, without anything in between.
struct SeenLamp {
  glm::dvec3 toLamp{0.0};      ///< unit
  glm::dvec3 irradiance{0.0};  ///< W/m2, on a surface that faces the lamp
  double cosine = 0.0;         ///< of the angle between the receiver's normal and the way to the lamp
  bool isSoft = false;         ///< so large that its shadows have soft edges

  bool shines() const { return irradiance != glm::dvec3(0.0); }
};

/// A lamp's light as it arrives at a receiver, by channel.
struct ArrivingLamp {
  glm::dvec3 direct{0.0};  ///< share of the lamp's own light, 0..1
  glm::dvec3 bounced{
      0.0};  ///< exit radiance over albedo of what bounces send of it, over the lamp's irradiance
};

/// Returns sharpened(s) = 0.5 + slope (s - 0.5) within 0 to 1 and T - s O of lampThroughTransfer(). Soft
/// lamps have a slope of 1.
ArrivingLamp arrivingLamp(const SeenLamp& lamp, const glm::dvec3& through, double open, double slope);

/// Returns exit radiance over albedo:
///
///   E (T - s O) + sharpened(s) E max(cosine, 0) / pi,  s = T / O within 0 to 1
///
/// with T = `through`, the transfer's value in the lamp's direction, and O = `open`, that of an open receiver
/// in the same basis (but for naive CH). Where nothing blocks the lamp this is its exact light, with what
/// bounces add to T; what truncation does to T cancels. s is sharpened if `sharp`, where T is visibility
/// alone, as truncation has blurred the edges of shadows. techniques/sh/transfer.glsl does the same.
glm::dvec3 lampThroughTransfer(const SeenLamp& lamp, const glm::dvec3& through, double open, bool sharp);

}  // namespace prelight
