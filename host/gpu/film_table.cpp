#include "gpu/film_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "shared/albedo_types.h"

namespace prelight {

namespace {

constexpr double circle = 2.0 * std::numbers::pi;

constexpr int filmCosines = PRELIGHT_FILM_COSINES, filmRoughnesses = PRELIGHT_FILM_ROUGHNESSES;
constexpr int facetBins = 128;  ///< bins of the cosine at microfacets

double squared(double x) { return x * x; }

double schlick(double f0, double cosine) { return f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0); }

double normalReflectance(double beyond, double here) { return squared((beyond - here) / (beyond + here)); }

/// Returns the linear sRGB colour of a reflectance that varies with the wavenumber like a cosine, by the
/// eye's three sensitivity curves as Gaussians in Fourier space ([Belcour and Barla 2017], section 4). `path`
/// is in nm.
glm::dvec3 seenColor(double path, const glm::dvec3& shift) {
  const double phase = circle * path * 1e-9;
  const auto gauss = [&](double height, double centre, double variance, double turn) {
    return height * std::sqrt(circle * variance) * std::cos(centre * phase + turn) *
           std::exp(-variance * phase * phase) / 1.0685e-7;
  };
  const double x =
      gauss(5.4856e-13, 1.6810e6, 4.3278e9, shift.x) + gauss(9.7470e-14, 2.2399e6, 4.5282e9, shift.x);
  const double y = gauss(4.4201e-13, 1.7953e6, 9.3046e9, shift.y);
  const double z = gauss(5.2481e-13, 2.2084e6, 6.6121e9, shift.z);
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

/// Returns the share of light that leaves from microfacets along a direction, in facetBins of the cosine at
/// the facet: an average over the visible normals (Dupuy and Benyoub 2023).
std::array<double, facetBins> leavesByFacet(double cosine, double alpha) {
  constexpr int turns = 24, heights = 96;
  std::array<double, facetBins> shares{};
  const glm::dvec3 wo(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  const glm::dvec3 v = glm::normalize(glm::dvec3(alpha * wo.x, 0.0, wo.z));
  const auto term = [&](double c) { return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * c * c); };
  for (int y = 0; y < heights; ++y) {
    const double step = (y + 0.5) / heights;
    const double z = 1.0 - (1.0 - step * step * step) * (1.0 + v.z);
    const double radius = std::sqrt(std::max(1.0 - z * z, 0.0));
    for (int x = 0; x < turns; ++x) {  // the other half is symmetric
      const double turn = 0.5 * circle * (x + 0.5) / turns;
      const glm::dvec3 c = glm::dvec3(radius * std::cos(turn), radius * std::sin(turn), z) + v;
      const glm::dvec3 h = glm::normalize(glm::dvec3(alpha * c.x, alpha * c.y, std::max(c.z, 1e-9)));
      const double along = std::clamp(glm::dot(wo, h), 0.0, 1.0), to = 2.0 * along * h.z - wo.z;
      if (to <= 0.0) continue;
      const double leaves = to * (wo.z + term(wo.z)) / (wo.z * term(to) + to * term(wo.z));
      // The share is split between the two nearest bins.
      const double at = std::clamp(along * facetBins - 0.5, 0.0, facetBins - 1.0);
      const auto bin = std::min(static_cast<std::size_t>(at), std::size_t{facetBins - 2});
      const double weight = 3.0 * step * step * leaves / (turns * heights);
      shares[bin] += weight * (1.0 - (at - double(bin)));
      shares[bin + 1] += weight * (at - double(bin));
    }
  }
  return shares;
}

using FacetShares = std::vector<std::array<double, facetBins>>;  ///< [roughness][cosine]

FacetShares makeFacetShares() {
  FacetShares kernel(std::size_t{filmRoughnesses} * filmCosines);
  parallelRanges(kernel.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double root = double(i / filmCosines) / (filmRoughnesses - 1);
      const double step = std::max(double(i % filmCosines), 0.05) / (filmCosines - 1);
      kernel[i] = leavesByFacet(std::min(step * step, 1.0), std::max(std::pow(root, 4.0), 1e-4));
    }
  });
  return kernel;
}

/// Returns the cosine-weighted mean of values that are interpolated over roots of cosines.
double meanOfFilmRow(const glm::vec4* row) {
  double sum = 0.0;
  const double step = 1.0 / (filmCosines - 1);
  for (int c = 0; c + 1 < filmCosines; ++c) {
    const double a = c * step, b = a + step, whole = std::pow(b, 4) - std::pow(a, 4);
    const double upper = (0.8 * (std::pow(b, 5) - std::pow(a, 5)) - a * whole) / step;
    sum += double(row[c].x) * (whole - upper) + double(row[c + 1].x) * upper;
  }
  return sum;
}

glm::dvec3 reflectanceBelow(const CompiledMaterial& m) {
  const double root = m.ior == 0.0f ? 1.0 : (double(m.ior) - 1.0) / (double(m.ior) + 1.0);
  return double(m.specular) * glm::min(root * root * glm::dvec3(m.specularColor), glm::dvec3(1.0));
}

}  // namespace

glm::dvec3 filmReflectance(double cosine, double outside, double ior, double thickness,
                           const glm::dvec3& below) {
  const double from = std::sqrt(std::max(1.0 - (1.0 - cosine * cosine) / (outside * outside), 0.0));
  const double sine2 = (1.0 - cosine * cosine) / (ior * ior);
  if (sine2 >= 1.0) return glm::dvec3(1.0);
  const double within = std::sqrt(1.0 - sine2);
  const double top = schlick(normalReflectance(ior, outside), from), enters = 1.0 - top;
  glm::dvec3 constant(0.0), wave(0.0), pair(0.0), shift(0.0);
  for (int c = 0; c < 3; ++c) {
    const double root = std::sqrt(std::min(below[c] + 1e-4, 0.9999)), base = (1.0 + root) / (1.0 - root);
    const double bottom = schlick(normalReflectance(base, ior), within);
    const double both = std::clamp(top * bottom, 1e-5, 0.9999);
    shift[c] = (ior < outside ? 0.0 : 0.5 * circle) + (base < ior ? 0.5 * circle : 0.0);
    pair[c] = std::sqrt(both);
    const double more = enters * enters * bottom / (1.0 - both);
    constant[c] = top + more;
    wave[c] = more - enters;
  }
  const double path = 2.0 * ior * thickness * within;
  const glm::dvec3 sum =
      constant + 2.0 * wave * pair * (seenColor(path, shift) + pair * seenColor(2.0 * path, 2.0 * shift));
  return glm::clamp(sum, 0.0, 1.0);
}

glm::vec2 filmThicknesses(const CompiledMaterial& m) {
  const Iridescence& film = m.iridescence;
  if (film.thicknessTexture.image < 0) return glm::vec2(film.thicknessMaximum);
  return {film.thicknessMinimum, film.thicknessMaximum};
}

std::vector<glm::vec4> makeFilmTable(const CompiledMaterial& material) {
  constexpr int thicknesses = PRELIGHT_FILM_THICKNESSES;
  const FacetShares kernel = makeFacetShares();
  const glm::dvec3 below = reflectanceBelow(material);
  const double outside = 1.0 + 0.5 * double(material.clearcoat.factor);
  const glm::dvec2 range(filmThicknesses(material));
  std::vector<glm::vec4> table(std::size_t{thicknesses} * filmRoughnesses * (filmCosines + 1),
                               glm::vec4(0.0f));
  for (int t = 0; t < thicknesses; ++t) {
    const double thickness = glm::mix(range.x, range.y, double(t) / (thicknesses - 1));
    std::array<glm::dvec3, facetBins> facets;
    for (std::size_t b = 0; b < facetBins; ++b)
      facets[b] = filmReflectance((double(b) + 0.5) / facetBins, outside, double(material.iridescence.ior),
                                  thickness, below);
    for (int r = 0; r < filmRoughnesses; ++r) {
      const int first = (t * filmRoughnesses + r) * filmCosines;
      for (int c = 0; c < filmCosines; ++c) {
        glm::dvec3 sum(0.0);
        const auto& shares = kernel[std::size_t(r * filmCosines + c)];
        for (std::size_t b = 0; b < facetBins; ++b) sum += shares[b] * facets[b];
        table[std::size_t(first + c)].x = static_cast<float>(std::max({sum.x, sum.y, sum.z}));
      }
      table[std::size_t(thicknesses * filmRoughnesses * filmCosines + t * filmRoughnesses + r)].x =
          static_cast<float>(meanOfFilmRow(table.data() + first));
    }
  }
  return table;
}

}  // namespace prelight
