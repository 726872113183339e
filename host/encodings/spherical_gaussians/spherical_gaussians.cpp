#include "encodings/encodings.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <numbers>
#include <string>

#include "basis/quadrature.h"
#include "basis/sh_zonal.h"
#include "encodings/encoding.h"
#include "encodings/least_squares.h"

// [1] Neubelt and Pettineo, "Advanced lighting R&D at Ready At Dawn Studios", 2015: lobes of fixed
// directions.

namespace prelight {
namespace {

/// Regularisation that distributes light evenly among overlapping lobes.
constexpr double ridge = 1e-5;

/// Returns the sharpness at which a lobe falls to a half at the edge of a cap as large as its share of the
/// hemisphere, where 1 - cos = 1 / count. Sharper lobes would suit irradiance slightly better and radiance
/// worse.
double sharpnessOf(std::size_t count) { return static_cast<double>(count) * std::numbers::ln2; }

/// Returns evenly spread directions on a spiral whose steps turn by the golden angle.
std::vector<glm::vec3> spiral(std::size_t count) {
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<glm::vec3> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double radius = std::sqrt(1.0 - z * z), phi = golden * static_cast<double>(i);
    directions.emplace_back(radius * std::cos(phi), radius * std::sin(phi), z);
  }
  return directions;
}

/// Returns the coefficients of the lobe's Legendre series: the integrals of f P_l over the sphere for l = 0
/// to 8.
std::array<double, 9> lobeSeries(double sharpness) {
  std::array<double, 9> series{};
  for (const LineSample& sample : gaussLegendre(40)) {
    const double x = sample.position, f = std::exp(sharpness * (x - 1.0));
    double before = 0.0, legendre = 1.0;
    for (int l = 0; l < 9; ++l) {
      series[static_cast<std::size_t>(l)] += 2.0 * std::numbers::pi * sample.weight * f * legendre;
      const double next = ((2.0 * l + 1.0) * x * legendre - l * before) / (l + 1.0);
      before = legendre;
      legendre = next;
    }
  }
  return series;
}

/// Returns the series after convolution with the clamped cosine (Funk and Hecke) as powers of x. Its only odd
/// band is the first, like the cosine's.
std::array<float, 6> irradianceOfLobe(double sharpness) {
  const std::array<double, 9> lobe = lobeSeries(sharpness);
  const auto band = [&](int l) {
    return (2.0 * l + 1.0) / 4.0 * sh::clampedCosine(l) * lobe[static_cast<std::size_t>(l)];
  };
  const double b2 = band(2) / 2.0, b4 = band(4) / 8.0, b6 = band(6) / 16.0, b8 = band(8) / 128.0;
  return {static_cast<float>(band(0) - b2 + 3.0 * b4 - 5.0 * b6 + 35.0 * b8),
          static_cast<float>(band(1)),
          static_cast<float>(3.0 * b2 - 30.0 * b4 + 105.0 * b6 - 1260.0 * b8),
          static_cast<float>(35.0 * b4 - 315.0 * b6 + 6930.0 * b8),
          static_cast<float>(231.0 * b6 - 12012.0 * b8),
          static_cast<float>(6435.0 * b8)};
}

float lobeIrradiance(const std::array<float, 6>& p, float x) {
  const float s = x * x;
  return p[0] + p[1] * x + s * (p[2] + s * (p[3] + s * (p[4] + s * p[5])));
}

/// The part of the fit that all places share.
template <std::size_t count>
struct LobeFit {
  FitFunctions<count> functions;
  GramMatrix<count> gram;

  LobeFit() {
    const GaussianLobes& lobes = gaussianLobes(count);
    functions = fitFunctions<count>([&](const glm::vec3& n) {
      std::array<float, count> values;
      for (std::size_t i = 0; i < count; ++i)
        values[i] = lobeIrradiance(lobes.irradiance, glm::dot(n, lobes.directions[i]));
      return values;
    });
    gram = gramMatrix<count>(functions);
    for (std::size_t i = 0; i < count; ++i) gram[i * count + i] *= 1.0 + ridge;
  }
};

template <std::size_t count>
void encodeSphericalGaussians(std::span<const float> incident, const glm::mat3& frame,
                              std::span<float> values) {
  assert(values.size() == 3 * count);
  static const LobeFit<count> fit;
  const FitColours<count> right = rightSide<count>(fit.functions, fitIrradiance(incident, frame));
  storeColours<count>(solveColours<count>(fit.gram, right, 0), values);
}

template <std::size_t count>
glm::vec3 sphericalGaussiansIrradiance(std::span<const float> values, const glm::mat3& frame,
                                       const glm::vec3& normal) {
  assert(values.size() == 3 * count);
  static const GaussianLobes& lobes = gaussianLobes(count);
  const glm::vec3 n = normal * frame;
  glm::vec3 sum(0.0f);
  for (std::size_t i = 0; i < count; ++i)
    sum += lobeIrradiance(lobes.irradiance, glm::dot(n, lobes.directions[i])) * storedColour(values, 3 * i);
  return glm::max(sum, glm::vec3(0.0f));
}

std::string sphericalGaussiansShader(std::size_t count) {
  const GaussianLobes& lobes = gaussianLobes(count);
  std::string text = fmt::format("const int encodedLobes = {};\nconst vec3 encodedDirections[{}] = vec3[{}](",
                                 count, count, count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3& d = lobes.directions[i];
    text += fmt::format("{}vec3({:.9e}, {:.9e}, {:.9e})", i > 0 ? ", " : "", d.x, d.y, d.z);
  }
  text += ");\nconst float encodedPowers[6] = float[6](";
  for (std::size_t i = 0; i < lobes.irradiance.size(); ++i)
    text += fmt::format("{}{:.9e}", i > 0 ? ", " : "", lobes.irradiance[i]);
  return text + ");\n" + std::string(encodingShader("spherical_gaussians"));
}

template <std::size_t count>
Encoding encodingOf(const char* name, const char* summary) {
  static const std::string shader = sphericalGaussiansShader(count);
  return {
      name,  summary, 3 * count, true, encodeSphericalGaussians<count>, sphericalGaussiansIrradiance<count>,
      shader};
}

}  // namespace

const GaussianLobes& gaussianLobes(std::size_t count) {
  static const auto make = [](std::size_t lobes) {
    return GaussianLobes{spiral(lobes), static_cast<float>(sharpnessOf(lobes)),
                         irradianceOfLobe(sharpnessOf(lobes))};
  };
  static const std::array<GaussianLobes, 4> all = {make(6), make(9), make(12), make(24)};
  for (const GaussianLobes& lobes : all)
    if (lobes.directions.size() == count) return lobes;
  assert(false);
  return all[0];
}

Encoding sphericalGaussiansEncoding(std::size_t count) {
  assert(count == 6 || count == 9 || count == 12 || count == 24);
  if (count == 6) return encodingOf<6>("sg-6", "six spherical Gaussians");
  if (count == 9) return encodingOf<9>("sg-9", "nine spherical Gaussians");
  if (count == 12) return encodingOf<12>("sg-12", "twelve spherical Gaussians");
  return encodingOf<24>("sg-24", "twenty-four spherical Gaussians");
}

}  // namespace prelight
