#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <glm/glm.hpp>
#include <numbers>

#include "gpu/film_table.h"
#include "transport/bsdf_probe.h"
#include "transport/chi_square.h"
#include "transport/sampler_checks.h"

// Thin films over metals and dielectrics (KHR_materials_iridescence).
namespace prelight::test {
namespace {

using std::numbers::pi;

/// One Gaussian of the colour matching curves over wavenumber in 1/m. In the extension's Fourier transform it
/// is a damping exp(-v k^2), which stands for a variance of 2 v.
double gaussian(double height, double centre, double damping, double wavenumber) {
  return height / std::numbers::sqrt2 *
         std::exp(-(wavenumber - centre) * (wavenumber - centre) / (4.0 * damping));
}

/// Reflectance in linear sRGB by brute force: Airy's sum over all reflections in the film at each of many
/// wavelengths, with the model's interfaces (Schlick's reflectances, phases of 0 or pi).
glm::dvec3 filmByWavelengths(double cosine, double ior, double thickness, double below) {
  const double within = std::sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
  const auto schlick = [](double f0, double c) { return f0 + (1.0 - f0) * std::pow(1.0 - c, 5.0); };
  const double base = (1.0 + std::sqrt(below)) / (1.0 - std::sqrt(below));
  const double top = schlick(std::pow((ior - 1.0) / (ior + 1.0), 2.0), cosine);
  const double bottom = schlick(std::pow((base - ior) / (base + ior), 2.0), within);
  // Amplitudes of reflection at the film from outside (phase pi, because it is denser), from inside, and at
  // the base.
  const double outer = -std::sqrt(top), inner = std::sqrt(top),
               deep = (base < ior ? 1.0 : -1.0) * std::sqrt(bottom);
  glm::dvec3 xyz(0.0), all(0.0);
  for (int i = 0; i < 20000; ++i) {
    const double wavenumber = 1.0e6 + 2.0e6 * (i + 0.5) / 20000;
    const std::complex<double> turn =
        std::polar(1.0, 2.0 * pi * 2.0 * ior * thickness * 1e-9 * within * wavenumber);
    const std::complex<double> amplitude = outer + (1.0 - top) * deep * turn / (1.0 - inner * deep * turn);
    const double reflected = std::norm(amplitude);
    const glm::dvec3 weight(gaussian(5.4856e-13, 1.6810e6, 4.3278e9, wavenumber) +
                                gaussian(9.7470e-14, 2.2399e6, 4.5282e9, wavenumber),
                            gaussian(4.4201e-13, 1.7953e6, 9.3046e9, wavenumber),
                            gaussian(5.2481e-13, 2.2084e6, 6.6121e9, wavenumber));
    xyz += reflected * weight;
    all += weight;
  }
  // The mean reflectance is white; only the variation around it passes through the colour curves.
  const double mean = top + (1.0 - top) * (1.0 - top) * bottom / (1.0 - top * bottom);
  const double width = 2.0e6 / 20000;
  const glm::dvec3 varies = (xyz - mean * all) * width / 1.0685e-7;
  return mean + glm::dvec3(3.2404542 * varies.x - 1.5371385 * varies.y - 0.4985314 * varies.z,
                           -0.9692660 * varies.x + 1.8760108 * varies.y + 0.0415560 * varies.z,
                           0.0556434 * varies.x - 0.2040259 * varies.y + 1.0572252 * varies.z);
}

// The model drops terms beyond the second.
TEST(Film, Reflectance_IsAirysSumOverWavelengths) {
  for (const double ior : {1.3, 1.8})
    for (const double below : {0.04, 0.2})
      for (const double thickness : {150.0, 400.0, 700.0})
        for (const double cosine : {1.0, 0.7, 0.4}) {
          const glm::dvec3 expected = filmByWavelengths(cosine, ior, thickness, below);
          const glm::dvec3 found = filmReflectance(cosine, 1.0, ior, thickness, glm::dvec3(below));
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], std::clamp(expected[c], 0.0, 1.0), 0.012)
                << ior << ' ' << below << ' ' << thickness << ' ' << cosine << ' ' << c;
        }
}

TEST(Film, OverALosslessMetal_ReflectsAllLight) {
  for (const double thickness : {100.0, 450.0})
    for (const double cosine : {1.0, 0.3, 0.05}) {
      const glm::dvec3 found = filmReflectance(cosine, 1.0, 1.4, thickness, glm::dvec3(1.0));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], 1.0, 5e-3);
    }
}

struct Filmed {
  const char* name;
  float diffuse, metalShare, roughness, share, ior, thickness;
  bool smooth = false;
};

const std::array filmedSurfaces{
    Filmed{"Oil", 1, 0, 0.3f, 1, 1.5f, 350}, Filmed{"Shell", 1, 0, 0.6f, 0.7f, 1.8f, 500},
    Filmed{"Matt", 1, 0, 1.0f, 1, 1.3f, 200}, Filmed{"Sharp", 1, 0, 0.1f, 1, 1.6f, 900},
    Filmed{"Steel", 0, 1, 0.4f, 1, 1.3f, 400}};

class FilmOver : public ::testing::TestWithParam<Filmed> {
 protected:
  static BsdfProbe filmed(const Filmed& s) {
    CompiledMaterial m;
    m.specular = 1.0f;
    m.iridescence.factor = 1.0f;
    m.iridescence.ior = s.ior;
    m.iridescence.thicknessMaximum = s.thickness;
    const float layer = s.diffuse > 0.0f ? 1.0f : 0.0f;
    std::vector<float> values{s.diffuse, s.diffuse, s.diffuse, 1, 1,     1,          s.metalShare,
                              0.04f,     0.04f,     0.04f,     1, layer, s.roughness};
    values.resize(34, 0.0f);
    values[18] = 1.0f;
    values[30] = s.share;
    values[31] = s.ior;
    values[32] = s.thickness;
    BsdfProbe probe{BuildOptions().define("PRELIGHT_GLOSSY").define("PRELIGHT_FILM"), values};
    probe.set(33, static_cast<float>(probe.append(makeFilmTable(m))));
    return probe;
  }
  BsdfProbe surface_ = filmed(GetParam());
};

// The film absorbs no light. A channel that it reflects less than another one loses light in the body, which
// is dimmed by the most reflective channel. A metal of colour 1 shows all light at every angle.
TEST_P(FilmOver, ReflectsNoMoreThanArrives) {
  constexpr std::size_t count = 1 << 17;
  for (const double cosine : {1.0, 0.8, 0.5, 0.25, 0.1}) {
    glm::dvec3 sum(0.0), squares(0.0);
    for (const ProbedSample& drawn : surface_.sample(directionOf(cosine, 0.3), count)) {
      sum += glm::dvec3(drawn.weight);
      squares += glm::dvec3(drawn.weight) * glm::dvec3(drawn.weight);
    }
    double largest = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double mean = sum[c] / count,
                   noise = std::sqrt(std::max(squares[c] / count - mean * mean, 0.0) / count);
      EXPECT_LT(mean, 1.004 + 3.0 * noise) << "cosine " << cosine;
      EXPECT_GT(mean, GetParam().metalShare > 0.0f ? 0.985 : 0.6) << "cosine " << cosine;
      largest = std::max(largest, mean);
    }
    EXPECT_GT(largest, 0.985) << "cosine " << cosine;
  }
}

TEST_P(FilmOver, Reflection_IsReciprocal) { expectReciprocity(surface_, 4e-4); }

TEST_P(FilmOver, Sampling_FollowsItsDensity) {
  if (GetParam().roughness < 0.2f) GTEST_SKIP() << "too sharp for the grid";
  for (const double cosine : {0.95, 0.5, 0.2}) expectSamplesToFollowDensity(surface_, cosine);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, FilmOver, ::testing::ValuesIn(filmedSurfaces),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace prelight::test
