#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "plot/drawing.h"
#include "prelight/measured_brdf.h"

/// Polar pictures of how surfaces reflect: the normal points up, and a curve's distance from the centre is
/// its value.
namespace prelight::plot {

/// A function of the angle to the normal in radians, from -pi to pi, and how it is shown.
struct PolarCurve {
  std::string caption;
  std::function<double(double angle)> value;
  Color color{};
};

enum class ReflectionLobe { Ggx, Phong };

/// Returns a reflection lobe of integral 1 about the normal: GGX of alpha = roughness^2 seen along the
/// normal, weighted by the cosine, or a power of the cosine of about the same width.
PolarCurve lobeCurve(ReflectionLobe lobe, double roughness);

/// Returns the lobe cut to the bands of an order.
PolarCurve lobeInHarmonics(ReflectionLobe lobe, double roughness, int order);

/// Returns the GGX BRDF of a white metal in the plane of incidence, for light from `incidence` radians.
PolarCurve metalCurve(double roughness, double incidence);

/// Returns a measured BRDF in the plane of incidence.
PolarCurve measuredCurve(const MeasuredBrdf& brdf, double incidence);

/// Returns the colour of the curve of a number, 0 to 4.
Color curveColor(std::size_t number);

/// Returns the curves over a grid of angles. Curves share a scale, or each fills the picture. Where a curve
/// is negative its line is thin.
Drawing plotPolar(std::span<const PolarCurve> curves, bool sharedScale);

}  // namespace prelight::plot
