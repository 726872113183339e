#include "radiosity/form_factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prelight/error.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using std::numbers::pi;

struct Factors {
  RadiosityElements elements;
  FormFactors f;
  std::uint64_t rays = 0;
};

Factors factorsOf(const CompiledScene& scene, double patchSize, std::uint32_t rays, std::uint64_t seed = 1) {
  Factors out;
  out.elements = makeElements(scene, patchSize);
  Tracer tracer(scene, test::sharedDevice());
  FormFactorCast cast(scene, out.elements, tracer, rays, seed);
  Progress progress;
  cast.run(progress);
  out.rays = cast.rays();
  out.f = makeFormFactors(out.elements, cast.counts(), std::uint64_t{1} << 30);
  return out;
}

double factor(const FormFactors& f, std::uint32_t i, std::uint32_t k) {
  return double(f.scale[i]) * f.values[k];
}

/// Form factor from the fronts of triangles [a, b) to those of triangles [c, d).
double between(const Factors& x, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const auto& first = x.elements.first;
  double area = 0.0, sum = 0.0;
  for (std::uint32_t i = first[a]; i < first[b]; ++i) {
    area += x.f.areas[i];
    for (std::uint32_t k = x.f.rowStart[i]; k < x.f.rowStart[i + 1]; ++k)
      if (x.f.columns[k] >= first[c] && x.f.columns[k] < first[d]) sum += x.f.areas[i] * factor(x.f, i, k);
  }
  return sum / area;
}

double rowSum(const FormFactors& f, std::uint32_t i) {
  double sum = 0.0;
  for (std::uint32_t k = f.rowStart[i]; k < f.rowStart[i + 1]; ++k) sum += factor(f, i, k);
  return sum;
}

/// Identical, parallel, directly opposed rectangles a x b at distance c (Howell, A Catalog of Radiation Heat
/// Transfer Configuration Factors, C-11).
double parallelPlates(double a, double b, double c) {
  const double x = a / c, y = b / c, x2 = 1 + x * x, y2 = 1 + y * y;
  return 2.0 / (pi * x * y) *
         (std::log(std::sqrt(x2 * y2 / (1 + x * x + y * y))) +
          x * std::sqrt(y2) * std::atan(x / std::sqrt(y2)) +
          y * std::sqrt(x2) * std::atan(y / std::sqrt(x2)) - x * std::atan(x) - y * std::atan(y));
}

/// Rectangles with the common edge l at a right angle, of widths w (from) and h (to) (Howell's catalogue,
/// C-14).
double perpendicularPlates(double l, double w, double h) {
  const double W = w / l, H = h / l, W2 = W * W, H2 = H * H, s = W2 + H2;
  const double logs = std::log((1 + W2) * (1 + H2) / (1 + s)) + W2 * std::log(W2 * (1 + s) / ((1 + W2) * s)) +
                      H2 * std::log(H2 * (1 + s) / ((1 + H2) * s));
  return (W * std::atan(1 / W) + H * std::atan(1 / H) - std::sqrt(s) * std::atan(1 / std::sqrt(s)) +
          0.25 * logs) /
         (pi * W);
}

/// Two triangles over corner + [0,1] a + [0,1] b, facing a x b.
CompiledScene plate(const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b) {
  return test::sceneOf({corner, corner + a, corner + a + b, corner + b}, {{0, 1, 2}, {0, 2, 3}});
}

TEST(FormFactors, ParallelPlates_AreTheClosedForm) {
  EXPECT_NEAR(parallelPlates(1, 1, 1), 0.1998, 1e-4);
  CompiledScene scene = plate({0, 0, 0}, {0, 0, 1}, {2, 0, 0});
  test::append(scene, plate({0, 0.8f, 0}, {2, 0, 0}, {0, 0, 1}));
  const Factors x = factorsOf(scene, 0.25, 2048);
  EXPECT_NEAR(between(x, 0, 2, 2, 4) / parallelPlates(2, 1, 0.8), 1.0, 0.005) << x.rays << " rays";
}

TEST(FormFactors, PerpendicularPlates_AreTheClosedForm) {
  EXPECT_NEAR(perpendicularPlates(1, 1, 1), 0.2000, 1e-4);
  CompiledScene scene = plate({0, 0, 0}, {0, 0, 1}, {1, 0, 0});    // Floor, width 1.
  test::append(scene, plate({0, 0, 0}, {0, 1.5f, 0}, {0, 0, 1}));  // Wall, height 1.5.
  const Factors x = factorsOf(scene, 0.2, 2048);
  EXPECT_NEAR(between(x, 0, 2, 2, 4) / perpendicularPlates(1, 1, 1.5), 1.0, 0.005);
  EXPECT_NEAR(between(x, 2, 4, 0, 2) / perpendicularPlates(1, 1.5, 1), 1.0, 0.005);
}

TEST(FormFactors, ConcentricSpheres_AreTheClosedForm) {
  CompiledScene scene = test::sphere(48, 1.0f, {0, 0, 0});
  const std::uint32_t inner = scene.triangleCount();
  CompiledScene outer = test::sphere(48, 2.0f, {0, 0, 0});
  for (glm::uvec3& t : outer.triangles) std::swap(t.y, t.z);
  outer = test::sceneOf(outer.positions, outer.triangles);
  test::append(scene, outer);
  const Factors x = factorsOf(scene, 10.0, 256);
  const std::uint32_t all = scene.triangleCount();
  EXPECT_NEAR(between(x, 0, inner, inner, all), 1.0, 1e-5);
  EXPECT_NEAR(between(x, inner, all, 0, inner) / 0.25, 1.0, 0.005);
  EXPECT_NEAR(between(x, inner, all, inner, all) / 0.75, 1.0, 0.005);
}

TEST(FormFactors, ClosedRoom_RowsSumToOneAndAreReciprocal) {
  CompiledScene scene = test::box(1, {0, 0, 0}, {4, 3, 5}, true);
  test::append(scene, test::box(1, {1, 0.5f, 1}, {2, 1.5f, 2}, false));
  const Factors x = factorsOf(scene, 0.7, 512);
  EXPECT_FALSE(x.f.backs);
  for (std::uint32_t i = 0; i < x.f.elementCount(); ++i) {
    ASSERT_EQ(x.f.escaped[i], 0.0f) << i;
    ASSERT_NEAR(rowSum(x.f, i), 1.0, 2e-7) << i;
    ASSERT_NEAR(x.f.scale[i] * x.f.areas[i], 1.0, 1e-3) << i;
  }
}

TEST(FormFactors, RoomWithAnOpening_RowsSumToOneWithTheSky) {
  CompiledScene scene = test::box(1, {0, 0, 0}, {4, 3, 5}, true);
  scene.triangles.resize(scene.triangles.size() - 2);
  scene = test::sceneOf(scene.positions, scene.triangles);
  const Factors x = factorsOf(scene, 0.7, 512);
  double open = 0.0, area = 0.0;
  for (std::uint32_t i = 0; i < x.f.elementCount(); ++i) {
    ASSERT_NEAR(rowSum(x.f, i) + x.f.escaped[i], 1.0, 2e-7) << i;
    open += x.f.areas[i] * x.f.escaped[i];
    area += x.f.areas[i];
  }
  // The opening sees walls in its whole hemisphere. By reciprocity the escaped shares times areas add up to
  // the opening's area.
  const double opening = 2 * (4 * 3 + 3 * 5 + 4 * 5) - area;
  EXPECT_NEAR(open / opening, 1.0, 0.005);
}

TEST(FormFactors, BothDirections_HalveTheVariance) {
  const CompiledScene scene = test::box(1, {0, 0, 0}, {2, 2, 2}, true);
  const RadiosityElements elements = makeElements(scene, 0.5);
  Tracer tracer(scene, test::sharedDevice());
  Progress progress;
  const auto squareError = [&](std::uint32_t rays, std::uint64_t seed, bool both, const FormFactors& truth) {
    FormFactorCast cast(scene, elements, tracer, rays, seed);
    cast.run(progress);
    std::vector<double> dense(std::size_t{elements.perSide()} * elements.perSide(), 0.0);
    if (both) {
      const FormFactors f = makeFormFactors(elements, cast.counts(), 1u << 30);
      for (std::uint32_t i = 0; i < f.elementCount(); ++i)
        for (std::uint32_t k = f.rowStart[i]; k < f.rowStart[i + 1]; ++k)
          dense[i * elements.perSide() + f.columns[k]] = factor(f, i, k);
    } else {
      const ExchangeCounts& c = cast.counts();
      for (std::uint32_t r = 0; r < c.elements.size(); ++r)
        for (std::uint64_t k = c.offsets[r]; k < c.offsets[r + 1]; ++k)
          dense[c.elements[r] * elements.perSide() + c.columns[k]] = double(c.counts[k]) / c.rays[r];
    }
    for (std::uint32_t i = 0; i < truth.elementCount(); ++i)
      for (std::uint32_t k = truth.rowStart[i]; k < truth.rowStart[i + 1]; ++k)
        dense[i * elements.perSide() + truth.columns[k]] -= factor(truth, i, k);
    double sum = 0.0;
    for (const double d : dense) sum += d * d;
    return sum;
  };
  FormFactorCast fine(scene, elements, tracer, 32768, 99);
  fine.run(progress);
  const FormFactors truth = makeFormFactors(elements, fine.counts(), 1u << 30);
  double one = 0.0, both = 0.0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    one += squareError(128, seed, false, truth);
    both += squareError(128, seed, true, truth);
  }
  EXPECT_LT(both / one, 0.65);
}

TEST(FormFactors, BackOfAPanel_IsAnElementOfItsOwn) {
  CompiledScene scene = test::box(1, {0, 0, 0}, {2, 2, 2}, true);
  const std::uint32_t room = scene.triangleCount();
  test::append(scene, plate({0.5f, 1.0f, 0.5f}, {1, 0, 0}, {0, 0, 1}));  // Faces down.
  const Factors x = factorsOf(scene, 0.5, 512);
  ASSERT_TRUE(x.f.backs);
  const std::uint32_t perSide = x.elements.perSide();
  double front = 0.0, back = 0.0;
  for (std::uint32_t i = x.elements.first[room]; i < perSide; ++i) {
    front += rowSum(x.f, i);
    back += rowSum(x.f, perSide + i);
    EXPECT_TRUE(x.f.isCast(perSide + i));
    EXPECT_FALSE(x.f.isCast(perSide));  // The back of a wall, outside the room.
  }
  EXPECT_NEAR(front, back, 1e-4);
  // The front of the panel sees nothing but the room.
  EXPECT_NEAR(between(x, room, room + 2, 0, room), 1.0, 1e-6);
}

TEST(FormFactors, HoleOfAnAlphaMask_DoesNotCount) {
  CompiledScene scene = test::ground(1, 1.0f);
  scene.materials[0].alphaCutoff = 0.5f;
  Image image{"mask", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}};
  scene.images.push_back(image);
  scene.materials[0].baseColorTexture.image = 0;
  scene.materials[0].baseColorTexture.wrapS = scene.materials[0].baseColorTexture.wrapT =
      WrapMode::ClampToEdge;
  for (std::size_t v = 0; v < scene.positions.size(); ++v)
    scene.texCoords[v] = {0.5f + 0.5f * scene.positions[v].x, 0.5f};
  const Factors x = factorsOf(scene, 0.1, 256);
  double area = 0.0;
  for (const float a : x.f.areas) area += a;
  EXPECT_NEAR(area, 2.0, 0.05);
}

TEST(FormFactors, SameSeed_SameBytes_OtherSeed_OtherOnes) {
  const CompiledScene scene = test::box(1, {0, 0, 0}, {2, 1, 3}, true);
  const Factors a = factorsOf(scene, 0.4, 128, 5), b = factorsOf(scene, 0.4, 128, 5),
                c = factorsOf(scene, 0.4, 128, 6);
  EXPECT_EQ(a.f.columns, b.f.columns);
  EXPECT_EQ(a.f.values, b.f.values);
  EXPECT_NE(a.f.values, c.f.values);
}

TEST(FormFactors, MoreThanTheMemory_IsSaid) {
  const CompiledScene scene = test::box(1, {0, 0, 0}, {2, 1, 3}, true);
  const RadiosityElements elements = makeElements(scene, 0.4);
  Tracer tracer(scene, test::sharedDevice());
  FormFactorCast cast(scene, elements, tracer, 128, 1);
  Progress progress;
  cast.run(progress);
  EXPECT_THROW(makeFormFactors(elements, cast.counts(), 1000), Error);
}

class StopAfter : public Progress {
 public:
  explicit StopAfter(int blocks) : blocks_(blocks) {}
  void report(std::string_view, double) override { --blocks_; }
  bool stopRequested() const override { return blocks_ <= 0; }

 private:
  int blocks_;
};

TEST(FormFactors, InterruptedAndResumed_AreTheSame) {
  CompiledScene scene = test::box(1, {0, 0, 0}, {2, 2, 2}, true);
  test::append(scene, plate({0.5f, 1.0f, 0.5f}, {1, 0, 0}, {0, 0, 1}));
  const RadiosityElements elements = makeElements(scene, 0.2);
  Tracer tracer(scene, test::sharedDevice());
  Progress progress;
  FormFactorCast whole(scene, elements, tracer, 512, 1);
  whole.run(progress);
  FormFactorCast first(scene, elements, tracer, 512, 1);
  StopAfter stop(3);
  EXPECT_THROW(first.run(stop), Interrupted);
  StateWriter writer;
  first.save(writer);
  const std::span<const std::byte> payload = writer.payload();
  StateReader reader("test", {payload.begin(), payload.end()});
  FormFactorCast second(scene, elements, tracer, 512, 1);
  second.load(reader);
  second.run(progress);
  EXPECT_EQ(whole.counts().columns, second.counts().columns);
  EXPECT_EQ(whole.counts().counts, second.counts().counts);
  EXPECT_EQ(whole.counts().elements, second.counts().elements);
}

}  // namespace
}  // namespace prelight
