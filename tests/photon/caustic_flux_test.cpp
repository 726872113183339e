#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "photon/photon_tracer.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"
#include "support/shot.h"

// Power of photons that smooth-shaded balls of few faces send onto a plane, square by square, compared with
// the path tracer, which finds the same light from the other end. Nothing is blurred: photons are counted,
// not filtered.
namespace prelight::test {
namespace {

constexpr int pixels = 64, squares = 8;
constexpr double half = 0.9;  // Half side of the visible part of the plane, m.
// The plane's albedo, so small that light which it scattered does not count.
constexpr float albedo = 0.001f;
constexpr std::uint64_t samples = 2048;
constexpr int batches = 64;  // Enough batches for their spread to give a good standard error.
constexpr std::uint64_t photonsABatch = 1 << 17;

/// Irradiance of 8 x 8 squares of the plane, W/m2, and its variance.
struct Squares {
  std::vector<double> mean = std::vector<double>(squares * squares, 0.0);
  std::vector<double> variance = std::vector<double>(squares * squares, 0.0);
};

struct BallCase {
  const char* name;
  int segments;  ///< Segments of the ball from pole to pole; there are twice as many around.
  CompiledMaterial material;
  bool above;  ///< Whether the plane hangs above the ball, where light comes through, rather than under it.
  /// Whether light passes straight through the ball, as direct light: then all light is compared.
  bool straight = false;
};

class CausticFlux : public ::testing::TestWithParam<BallCase> {
 protected:
  double height() const { return GetParam().above ? 2.0 : 0.0; }
  double middle() const { return GetParam().above ? 0.9 : 0.4; }

  /// A ball beside and above a lamp that shines upwards.
  CompiledScene scene(const CompiledMaterial& ball) const {
    CompiledScene scene = ground(1, 3.0f, static_cast<float>(height()));
    if (GetParam().above)
      for (glm::uvec3& t : scene.triangles) std::swap(t.y, t.z);
    scene.materials[0] = lambert(albedo);
    CompiledScene lamp = ground(1, 1.1f);
    for (glm::vec3& p : lamp.positions) p += glm::vec3(-1.6f, 0.02f, 0.1f);
    append(scene, lamp);
    append(scene, sphere(GetParam().segments, 0.5f, {0.1f, 0.8f, 0.0f}));
    scene.materials[1] = emitter(glm::vec3(10.0f));
    scene.materials[2] = ball;
    return scene;
  }

  Squares traced(const CompiledMaterial& ball, std::uint64_t seed) const {
    const double eye = height() + (GetParam().above ? -0.01 : 0.01);
    Shot shot = shotOf(scene(ball), orthographicCamera({middle(), eye, 0}, {middle(), height(), 0}, half),
                       pixels, samples);
    shot.request.seed = seed;
    const reference::Film film = shot.render();
    const std::vector<float> variance = film.variance();
    constexpr int side = pixels / squares;
    const double scale = std::numbers::pi / static_cast<double>(albedo) / (side * side);
    Squares result;
    for (int y = 0; y < pixels; ++y)
      for (int x = 0; x < pixels; ++x) {
        // Seen from below, x runs the other way.
        const int column = GetParam().above ? squares - 1 - x / side : x / side;
        const auto square = static_cast<std::size_t>(y / side * squares + column);
        const auto pixel = static_cast<std::size_t>(y * pixels + x);
        result.mean[square] += scale * film.means[pixel];
        result.variance[square] += scale * scale * static_cast<double>(variance[pixel]);
      }
    return result;
  }

  std::vector<double> landed(const PhotonHits& hits) const {
    std::vector<double> irradiance(squares * squares, 0.0);
    for (const device::Photon& p : hits.photons) {
      if (p.triangle >= 2) continue;  // Not on the plane.
      const double x = (double(p.position[0]) - middle()) / half, z = double(p.position[2]) / half;
      if (std::max(std::abs(x), std::abs(z)) >= 1.0) continue;
      const int column = static_cast<int>((x + 1.0) * squares / 2.0),
                row = static_cast<int>((z + 1.0) * squares / 2.0);
      irradiance[static_cast<std::size_t>(row * squares + column)] +=
          double(p.power[0]) / std::pow(2.0 * half / squares, 2.0);
    }
    return irradiance;
  }

  Squares sent() const {
    const CompiledScene ball = scene(GetParam().material);
    TransportScene transport({ball, noImages(), {}, nullptr}, sharedDevice());
    PhotonTracer tracer(ball, transport);
    Progress progress;
    Squares result;
    std::vector<double> squaresOf(squares * squares, 0.0);
    for (std::uint64_t batch = 0; batch < batches; ++batch) {
      PhotonHits hits;
      tracer.trace({.kind = GetParam().straight ? PhotonKind::All : PhotonKind::Caustic,
                    .photons = photonsABatch,
                    .seed = 100 + batch,
                    .rouletteDepth = 8},
                   hits, progress);
      const std::vector<double> found = landed(hits);
      for (std::size_t s = 0; s < found.size(); ++s) {
        result.mean[s] += found[s] / batches;
        squaresOf[s] += found[s] * found[s] / batches;
      }
    }
    for (std::size_t s = 0; s < squaresOf.size(); ++s)
      result.variance[s] = std::max(squaresOf[s] - result.mean[s] * result.mean[s], 0.0) / (batches - 1);
    return result;
  }
};

TEST_P(CausticFlux, Photons_LandWherePathTracingSeesTheirLight) {
  const Squares all = traced(GetParam().material, 1), direct = traced(lambert(0.0f), 2), photons = sent();
  double worst = 0.0, squareSum = 0.0, truthSum = 0.0, photonSum = 0.0, variance = 0.0;
  int beyond = 0;
  for (std::size_t s = 0; s < squares * squares; ++s) {
    const double known = GetParam().straight ? 0.0 : 1.0;
    const double truth = all.mean[s] - known * direct.mean[s];
    const double squared = all.variance[s] + known * direct.variance[s] + photons.variance[s];
    const double z = (photons.mean[s] - truth) / std::sqrt(squared);
    EXPECT_LT(std::abs(z), 4.0) << "square " << s << ": " << photons.mean[s] << ", path tracing has "
                                << truth;
    if (std::abs(z) > 3.0) ++beyond;
    worst = std::max(worst, std::abs(z));
    squareSum += z * z;
    truthSum += truth;
    photonSum += photons.mean[s];
    variance += squared;
  }
  // Student's t with 63 degrees of freedom: a quarter of a square of 64 is expected beyond 3.
  EXPECT_LE(beyond, 1);
  EXPECT_LT(squareSum / (squares * squares), 1.5);
  EXPECT_NEAR(photonSum, truthSum, 3.0 * std::sqrt(variance));
  RecordProperty("worstSquare", std::to_string(worst));
  RecordProperty("rmsOfSquares", std::to_string(std::sqrt(squareSum / (squares * squares))));
  RecordProperty("ratioOfSums", std::to_string(photonSum / truthSum));
  RecordProperty("errorOfRatio", std::to_string(std::sqrt(variance) / truthSum));
}

INSTANTIATE_TEST_SUITE_P(Balls, CausticFlux,
                         ::testing::Values(BallCase{"CoarseMirror", 6, metal(0.9f, 0.0f), false},
                                           BallCase{"FinerMirror", 24, metal(0.9f, 0.0f), false},
                                           BallCase{"CoarseNarrowMetal", 6, metal(0.9f, 0.15f), false},
                                           BallCase{"CoarseGlass", 6, glass(1.5f, true), true},
                                           BallCase{"FinerGlass", 24, glass(1.5f, true), true},
                                           BallCase{"CoarseThinGlass", 6, glass(1.5f, false), true, true}),
                         [](const auto& ball) { return std::string(ball.param.name); });

}  // namespace
}  // namespace prelight::test
