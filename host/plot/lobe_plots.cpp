#include "plot/lobe_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/sh_zonal.h"
#include "basis/sky_lobes.h"
#include "scene/measured_brdf.h"

namespace prelight::plot {
namespace {

using std::numbers::pi;
constexpr int side = 480;
constexpr Color gridColor{205, 205, 205};

double ggx(double alpha, double cosine) {
  const double d = cosine * cosine * (alpha * alpha - 1.0) + 1.0;
  return alpha * alpha / (pi * d * d);
}

/// Returns the exponent whose Blinn lobe is as wide as GGX of this roughness, for lobes about the mirror
/// direction.
double exponentOf(double roughness) {
  return std::max(0.5 / std::pow(std::max(roughness, 0.02), 4.0) - 0.5, 0.0);
}

/// Returns the GGX lobe, not normalised.
double ggxLobe(double alpha, double angle) {
  const double cosine = std::cos(angle);
  return cosine > 0.0 ? ggx(alpha, std::cos(0.5 * angle)) * cosine : 0.0;
}

/// Returns the integral over the sphere of a function of the angle to the normal.
double integralOf(const std::function<double(double)>& value) {
  constexpr int steps = 20000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    // Steps grow with the angle: narrow lobes need fine ones near the axis.
    const double t = (i + 0.5) / steps, angle = pi * t * t * t;
    sum += value(angle) * std::sin(angle) * 3.0 * pi * t * t / steps;
  }
  return 2.0 * pi * sum;
}

/// Returns the masking and shadowing of both directions over 4 cos cos (Heitz 2014).
double visibility(double alpha, double in, double out) {
  const double a2 = alpha * alpha;
  const double v = out * std::sqrt(in * in * (1.0 - a2) + a2),
               l = in * std::sqrt(out * out * (1.0 - a2) + a2);
  return 0.5 / std::max(v + l, 1e-12);
}

glm::dvec3 inPlane(double angle) { return {std::sin(angle), 0.0, std::cos(angle)}; }

glm::dvec2 placeOf(double angle, double distance) {
  return glm::dvec2(0.5 * side, 0.5 * side) +
         0.46 * side * distance * glm::dvec2(std::sin(angle), -std::cos(angle));
}

void addGrid(Drawing& drawing) {
  for (const double radius : {0.25, 0.5, 0.75, 1.0})
    addCircle(drawing, {0.5 * side, 0.5 * side}, 0.46 * side * radius, gridColor, 1.0);
  for (int degrees = 0; degrees < 360; degrees += 30) {
    const double angle = degrees * pi / 180.0;
    drawing.lines.push_back({{placeOf(angle, 0.0), placeOf(angle, 1.0)}, gridColor, 1.0});
    if (degrees <= 90 || degrees >= 270)
      drawing.labels.push_back({placeOf(angle, 1.04) + glm::dvec2(0.0, 4.0),
                                fmt::format("{}°", degrees <= 90 ? degrees : degrees - 360)});
  }
}

constexpr int curveSteps = 2880;

double angleOf(int step) { return -pi + 2.0 * pi * step / curveSteps; }

double peakOf(const PolarCurve& curve) {
  double peak = 0.0;
  for (int i = 0; i <= curveSteps; ++i) peak = std::max(peak, std::abs(curve.value(angleOf(i))));
  return peak;
}

void addCurve(Drawing& drawing, const PolarCurve& curve, double scale) {
  Line line{{}, curve.color, 2.0};
  bool negative = false;
  for (int i = 0; i <= curveSteps; ++i) {
    const double value = curve.value(angleOf(i));
    if ((value < 0.0) != negative && !line.points.empty()) {
      drawing.lines.push_back(line);
      line.points.clear();
    }
    negative = value < 0.0;
    line.width = negative ? 0.8 : 2.0;
    line.points.push_back(placeOf(angleOf(i), std::abs(value) / scale));
  }
  drawing.lines.push_back(line);
}

}  // namespace

PolarCurve lobeCurve(ReflectionLobe lobe, double roughness) {
  const std::string caption =
      fmt::format("{}, roughness {:g}", lobe == ReflectionLobe::Ggx ? "GGX" : "Phong", roughness);
  if (lobe == ReflectionLobe::Phong) {
    const double exponent = exponentOf(roughness);
    return {caption, [exponent](double angle) {
              const double cosine = std::max(std::cos(angle), 0.0);
              return cosine > 0.0 ? (exponent + 1.0) / (2.0 * pi) * std::pow(cosine, exponent) : 0.0;
            }};
  }
  const double alpha = roughness * roughness;
  const double whole = integralOf([alpha](double angle) { return ggxLobe(alpha, angle); });
  return {caption, [alpha, whole](double angle) { return ggxLobe(alpha, angle) / whole; }};
}

PolarCurve lobeInHarmonics(ReflectionLobe lobe, double roughness, int order) {
  std::vector<double> factors;
  if (lobe == ReflectionLobe::Ggx) {
    factors = lobeFactors(roughness * roughness, order);
  } else {
    factors.resize(static_cast<std::size_t>(order));
    sh::cosinePowerZonal(exponentOf(roughness), factors);
    for (std::size_t l = 0; l < factors.size(); ++l)
      factors[l] *= std::sqrt(4.0 * pi / (2.0 * double(l) + 1.0));
  }
  for (std::size_t l = 0; l < factors.size(); ++l) factors[l] *= (2.0 * double(l) + 1.0) / (4.0 * pi);
  return {fmt::format("order {}", order),
          [factors](double angle) { return sh::legendreSum(factors, std::cos(angle)); }};
}

PolarCurve metalCurve(double roughness, double incidence) {
  const double alpha = roughness * roughness;
  return {fmt::format("light from {:.0f}°", incidence * 180.0 / pi), [alpha, incidence](double angle) {
            const glm::dvec3 in = inPlane(-incidence), out = inPlane(angle);
            if (out.z <= 0.0) return 0.0;
            return ggx(alpha, glm::normalize(in + out).z) * visibility(alpha, in.z, out.z);
          }};
}

PolarCurve measuredCurve(const MeasuredBrdf& brdf, double incidence) {
  return {fmt::format("light from {:.0f}°", incidence * 180.0 / pi), [&brdf, incidence](double angle) {
            const glm::dvec3 in = inPlane(-incidence), out = inPlane(angle);
            if (out.z <= 0.0) return 0.0;
            glm::dvec3 value = glm::dvec3(brdf.diffuse) / pi;
            if (!brdf.rest.empty()) value += brdfAt(brdf.rest, out, in);
            return (value.r + value.g + value.b) / 3.0;
          }};
}

Color curveColor(std::size_t number) {
  constexpr std::array<Color, 5> colors = {
      {{40, 40, 40}, {214, 84, 36}, {40, 120, 200}, {60, 150, 70}, {150, 70, 180}}};
  return colors[number % colors.size()];
}

Drawing plotPolar(std::span<const PolarCurve> curves, bool sharedScale) {
  Drawing drawing = blankDrawing(side, side + static_cast<int>(curves.size()) * captionHeight);
  addGrid(drawing);
  double greatest = 0.0;
  for (const PolarCurve& curve : curves) greatest = std::max(greatest, peakOf(curve));
  int row = 0;
  for (const PolarCurve& curve : curves) {
    const double peak = peakOf(curve);
    addCurve(drawing, curve, sharedScale ? greatest : peak);
    drawing.labels.push_back({{0.5 * side, side + 12.0 + captionHeight * row++},
                              fmt::format("{}: at most {:.3g} per sr", curve.caption, peak),
                              curve.color});
  }
  return drawing;
}

}  // namespace prelight::plot
