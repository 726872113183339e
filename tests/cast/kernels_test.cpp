#include <gtest/gtest.h>

#include <random>

#include "basis/sh.h"
#include "basis/sh_evaluate.h"
#include "device/buffer.h"
#include "device/kernel.h"
#include "gpu/tracer.h"
#include "receivers/sampling.h"
#include "shared/cast_types.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::CastParameters;
using device::Hit;
using device::Ray;
using device::Receiver;
using device::Sender;

constexpr std::uint32_t raysPerReceiver = 32;

Receiver receiverOf(const glm::vec3& p, const glm::vec3& n, std::uint32_t seed, std::uint32_t firstSample) {
  return {{p.x, p.y, p.z}, 7, {n.x, n.y, n.z}, seed, {n.x, n.y, n.z}, firstSample};
}

std::vector<Receiver> someReceivers(std::size_t count, std::uint32_t rays = raysPerReceiver) {
  std::mt19937 random(1);
  std::vector<Receiver> receivers;
  for (std::size_t i = 0; i < count; ++i)
    receivers.push_back(receiverOf(test::randomDirection(random), test::randomDirection(random),
                                   static_cast<std::uint32_t>(random()),
                                   static_cast<std::uint32_t>(rays * i * 5)));
  receivers.push_back(receiverOf({0, 0, 0}, {0, 0, -1}, 3, 0));
  receivers.push_back(receiverOf({0, 0, 0}, {0, 0, 1}, 0, 1u << 20));
  return receivers;
}

std::vector<Ray> generate(DeviceContext& device, const std::vector<Receiver>& receivers,
                          std::uint32_t count = raysPerReceiver) {
  const CastParameters parameters{
      static_cast<std::uint32_t>(receivers.size()), count, 4, 0, 0, 0.0f, 0.0f, 0.0f};
  Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  Buffer<Receiver> receiverBuffer(device, std::span<const Receiver>(receivers));
  Buffer<Ray> rays(device, receivers.size() * count);
  launchOnce(device, "cast/generate_kernels.cl", {}, "generateRays", rays.size() / 8, parameterBuffer,
             receiverBuffer, rays);
  return rays.read();
}

glm::dvec3 directionOf(const Ray& ray) { return {ray.direction[0], ray.direction[1], ray.direction[2]}; }

glm::dvec3 normalOf(const Receiver& r) { return {r.normal[0], r.normal[1], r.normal[2]}; }

/// Moves bit `from` of x to bit `to`.
std::uint32_t movedBit(std::uint32_t x, unsigned from, unsigned to) { return ((x >> from) & 1u) << to; }

class GenerateRays : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(GenerateRays, Block_IsTheSequencesAlongAMortonCurve) {
  const std::uint32_t count = GetParam();
  unsigned bits = 0;
  while ((1u << bits) < count) ++bits;
  const auto receivers = someReceivers(50, count);
  const auto rays = generate(test::sharedDevice().context(), receivers, count);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const Receiver& r = receivers[i];
    std::vector<char> slots(count, 0);
    for (std::uint32_t sample = 0; sample < count; ++sample) {
      const glm::dvec2 u = sampling::sobol(r.firstSample + sample, r.seed);
      // The cell of the square that holds the point; columns are halved first.
      const auto column = static_cast<std::uint32_t>(u.x * (1u << ((bits + 1) / 2)));
      const auto row = static_cast<std::uint32_t>(u.y * (1u << (bits / 2)));
      std::uint32_t slot = 0;
      for (unsigned bit = 0; bit < bits; ++bit) {
        const unsigned level = (bits - 1 - bit) / 2;
        const bool ofColumn = (bits - 1 - bit) % 2 == 0;
        slot |= ofColumn ? movedBit(column, (bits + 1) / 2 - 1 - level, bit)
                         : movedBit(row, bits / 2 - 1 - level, bit);
      }
      slots[slot] = 1;
      const Ray& ray = rays[i * count + slot];
      const glm::dvec3 expected = sampling::cosineHemisphere(u, normalOf(r));
      EXPECT_NEAR(glm::distance(directionOf(ray), expected), 0.0, 3e-6)
          << "receiver " << i << " slot " << slot;
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(ray.origin[axis], r.position[axis]);
      EXPECT_EQ(ray.sourceTriangle, 7u);
    }
    EXPECT_EQ(std::count(slots.begin(), slots.end(), 1), count) << "every cell holds one point";
  }
}

INSTANTIATE_TEST_SUITE_P(RaysPerReceiver, GenerateRays, ::testing::Values(8u, 16u, 32u, 64u, 128u, 256u));

TEST(GenerateRays, RunsOfEightOfSixtyFour_FillCompactCones) {
  const auto receivers = someReceivers(50, 64);
  const auto rays = generate(test::sharedDevice().context(), receivers, 64);
  // The mean direction of a full cosine-weighted hemisphere has length 2/3.
  const auto resultant = [&](std::size_t run) {
    double sum = 0.0;
    for (std::size_t first = 0; first < rays.size(); first += run) {
      glm::dvec3 mean(0.0);
      for (std::size_t i = first; i < first + run; ++i) mean += directionOf(rays[i]) / double(run);
      sum += glm::length(mean) * double(run) / double(rays.size());
    }
    return sum;
  };
  EXPECT_NEAR(resultant(64), 2.0 / 3.0, 0.01);
  EXPECT_GT(resultant(16), 0.85);
  EXPECT_GT(resultant(8), 0.92);
}

TEST(GenerateRays, RayBelowTheTriangle_MayHitIt) {
  auto receivers = someReceivers(20, 64);
  for (Receiver& r : receivers) {
    const glm::vec3 tilted = glm::normalize(glm::vec3(r.normal[0] + 0.5f, r.normal[1], r.normal[2] - 0.4f));
    for (int axis = 0; axis < 3; ++axis) r.geometricNormal[axis] = tilted[axis];
  }
  const auto rays = generate(test::sharedDevice().context(), receivers, 64);
  std::size_t below = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto& g = receivers[i / 64].geometricNormal;
    const double height = glm::dot(directionOf(rays[i]), glm::dvec3(g[0], g[1], g[2]));
    if (std::abs(height) > 1e-5) {
      EXPECT_EQ(rays[i].sourceTriangle, height > 0.0 ? 7u : PRELIGHT_NO_TRIANGLE);
    }
    below += height < 0.0;
  }
  EXPECT_GT(below, 50u);
}

// A (0,2)-sequence puts one of its first 2^k points into every elementary interval of area 2^-k.
TEST(Sobol, EveryPowerOfTwoPrefix_FillsElementaryIntervals) {
  for (const std::uint32_t seed : {0u, 1u, 77u})
    for (int k = 1; k <= 8; ++k)
      for (int a = 0; a <= k; ++a) {
        const std::uint32_t columns = 1u << a, rows = 1u << (k - a);
        std::vector<int> count(columns * rows, 0);
        for (std::uint32_t i = 0; i < (1u << k); ++i) {
          const glm::dvec2 u = sampling::sobol(i, seed);
          ++count[static_cast<std::uint32_t>(u.x * columns) * rows + static_cast<std::uint32_t>(u.y * rows)];
        }
        EXPECT_EQ(std::count(count.begin(), count.end(), 1), static_cast<std::ptrdiff_t>(count.size()))
            << "seed " << seed << " k " << k << " a " << a;
      }
}

// If a second sequence advanced in step with the first, its points would be correlated with the first's. The
// shuffle must break this and still visit every index of an aligned block once.
TEST(ShuffledIndex, AlignedBlocks_ArePermuted) {
  for (const std::uint32_t block : {1u, 2u, 16u, 256u}) {
    std::vector<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < block; ++i)
      seen.push_back(sampling::shuffledIndex(3 * block + i, 9) % block);
    std::sort(seen.begin(), seen.end());
    for (std::uint32_t i = 0; i < block; ++i) EXPECT_EQ(seen[i], i) << "block of " << block;
  }
}

TEST(ShuffledIndex, ProductOfTwoSequences_ConvergesForEverySeed) {
  double worstInStep = 0.0;
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    double shuffled = 0.0, inStep = 0.0;
    constexpr std::uint32_t count = 4096;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double u = sampling::sobol(i, seed).x;
      shuffled += u * sampling::sobol(sampling::shuffledIndex(i, seed + 100), seed + 200).x / count;
      inStep += u * sampling::sobol(i, seed + 200).x / count;
    }
    // Independent points have a standard deviation of 1/12 / sqrt(4096) = 0.0013.
    EXPECT_NEAR(shuffled, 0.25, 0.006) << "seed " << seed;
    worstInStep = std::max(worstInStep, std::abs(inStep - 0.25));
  }
  EXPECT_GT(worstInStep, 0.02) << "what the shuffle is there for";
}

TEST(CosineHemisphere, MeanOfCosine_IsTwoThirds) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, -0.5, 0.2));
  double sum = 0.0;
  for (std::uint32_t i = 0; i < 4096; ++i)
    sum += glm::dot(n, sampling::cosineHemisphere(sampling::sobol(i, 5), n));
  EXPECT_NEAR(sum / 4096, 2.0 / 3.0, 1e-4);
}

class ProjectHits : public ::testing::TestWithParam<int> {};

TEST_P(ProjectHits, RandomHits_AgreeWithDoubleReference) {
  const int order = GetParam();
  DeviceContext& device = test::sharedDevice().context();
  const auto receivers = someReceivers(40);
  const auto rays = generate(device, receivers);
  std::mt19937 random(order);
  std::vector<Hit> hits;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    // Receivers range from entirely open to entirely closed.
    const double closed = double(i / raysPerReceiver) / double(receivers.size() - 1);
    const bool hit = std::uniform_real_distribution<double>(0, 1)(random) < closed;
    hits.push_back({0, hit ? 3u : PRELIGHT_NO_TRIANGLE, 0, 0});
  }
  const auto n = static_cast<std::size_t>(order * order);
  const CastParameters parameters{static_cast<std::uint32_t>(receivers.size()),
                                  raysPerReceiver,
                                  static_cast<std::uint32_t>(4 + n),
                                  0,
                                  0,
                                  0.0f,
                                  0.0f,
                                  0.0f};
  Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  Buffer<float> table(device, std::span<const float>(makeShTable(std::max(1, order))));
  Buffer<Ray> rayBuffer(device, std::span<const Ray>(rays));
  Buffer<Hit> hitBuffer(device, std::span<const Hit>(hits));
  Buffer<float> values(device, receivers.size() * (4 + n));
  launchOnce(device, "project/project_kernels.cl", BuildOptions().define("PRELIGHT_SH_ORDER", order),
             "projectHits", receivers.size(), parameterBuffer, table, rayBuffer, hitBuffer, values);
  const auto result = values.read();

  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const auto open = [&](std::size_t j) {
      return hits[r * raysPerReceiver + j].triangle == PRELIGHT_NO_TRIANGLE ? 1.0 : 0.0;
    };
    double openFraction = 0.0;
    for (std::size_t j = 0; j < raysPerReceiver; ++j) openFraction += open(j) / raysPerReceiver;
    std::vector<double> expected(4 + n, 0.0), y(n);
    expected[0] = openFraction;
    for (std::size_t j = 0; j < raysPerReceiver; ++j) {
      const auto& d = rays[r * raysPerReceiver + j].direction;
      const double weight = (open(j) - openFraction) / raysPerReceiver;
      for (std::size_t axis = 0; axis < 3; ++axis) expected[1 + axis] += weight * d[axis];
      if (order == 0) continue;
      sh::evaluate(glm::normalize(glm::dvec3(d[0], d[1], d[2])), order, y);
      for (std::size_t i = 0; i < n; ++i) expected[4 + i] += weight * y[i];
    }
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(result[r * (4 + n) + i], expected[i], 3e-6) << "receiver " << r << " value " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, ProjectHits, ::testing::Values(0, 1, 3, 5, 8));

class TransportKernels : public ::testing::Test {
 protected:
  TransportKernels() {
    scene_ = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                           {{0, 1, 2}, {3, 4, 5}}, 0.5f);
    scene_.materials.push_back(scene_.materials[0]);
    scene_.materials[1].albedo = {0.25f, 0.5f, 1.0f};
    scene_.triangleMaterials[1] = 1;
  }

  CompiledScene scene_;
};

TEST_F(TransportKernels, StoreSenders_PicksCornersByWeightAndMarksBacks) {
  DeviceContext& device = test::sharedDevice().context();
  Tracer tracer(scene_, test::sharedDevice());
  constexpr std::size_t receivers = 256;
  std::vector<Receiver> receiverData;
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  for (std::size_t i = 0; i < receivers * raysPerReceiver; ++i) {
    if (i % raysPerReceiver == 0)
      receiverData.push_back(receiverOf({}, {0, 0, 1}, static_cast<std::uint32_t>(i), 0));
    const std::uint32_t triangle = i % 4 == 3 ? PRELIGHT_NO_TRIANGLE : static_cast<std::uint32_t>(i % 2);
    rays.push_back({{0, 0, 0},
                    PRELIGHT_NO_TRIANGLE,
                    {0, 0, triangle == 1 ? 1.0f : -1.0f},
                    1e30f});  // Rays hit the back of triangle 1.
    hits.push_back({1, triangle, 0.5f, 0.125f});
  }
  const CastParameters parameters{receivers, raysPerReceiver, 4, scene_.vertexCount(), 2, 0.0f, 0.0f, 0.0f};
  Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  Buffer<Ray> rayBuffer(device, std::span<const Ray>(rays));
  Buffer<Hit> hitBuffer(device, std::span<const Hit>(hits));
  Buffer<Receiver> receiverBuffer(device, std::span<const Receiver>(receiverData));
  Buffer<float> normals(device, std::span<const float>(std::vector<float>{0, 0, 1, 0, 0, 1}));
  Buffer<Sender> senders(device, (receivers + 2) * raysPerReceiver);
  Buffer<std::uint8_t> marks(device, 2);
  marks.fill(0);
  launchOnce(device, "cast/transport_kernels.cl", tracer.surfaceOptions().define("PRELIGHT_COLUMNS", 1),
             "storeSenders", rays.size(), parameterBuffer, tracer.scene().layoutBuffer(),
             tracer.scene().surface(), normals, receiverBuffer, rayBuffer, hitBuffer, senders, marks);

  EXPECT_EQ(marks.read(), (std::vector<std::uint8_t>{0, 1}));
  const auto rows = senders.read();
  std::vector<double> picked(12, 0.0);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Sender& s = rows[2 * raysPerReceiver + i];
    if (hits[i].triangle == PRELIGHT_NO_TRIANGLE) {
      EXPECT_EQ(s.vertex, PRELIGHT_NO_TRIANGLE);
      continue;
    }
    ASSERT_LT(s.vertex, 12u);
    picked[s.vertex] += 1.0;
    const glm::vec3 albedo = scene_.materials[hits[i].triangle].albedo;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(((s.albedo >> (10 * c)) & 1023u) / 1023.0, albedo[c], 0.0005);
  }
  const double even = picked[0] + picked[1] + picked[2];
  const double odd = picked[9] + picked[10] + picked[11];  // Back faces come after the vertices.
  EXPECT_EQ(even + odd, receivers * raysPerReceiver * 0.75);
  EXPECT_NEAR(picked[0] / even, 0.375, 0.03);
  EXPECT_NEAR(picked[1] / even, 0.5, 0.03);
  EXPECT_NEAR(picked[11] / odd, 0.125, 0.03);
}

class GatherBounce : public TransportKernels, public testing::WithParamInterface<int> {};

INSTANTIATE_TEST_SUITE_P(PartValues, GatherBounce, testing::Values(8, 16));

TEST_P(GatherBounce, AnyPart_AgreesWithDoubleReference) {
  const auto width = static_cast<std::size_t>(GetParam());
  DeviceContext& device = test::sharedDevice().context();
  Tracer tracer(scene_, test::sharedDevice());
  constexpr int order = 3;
  constexpr std::size_t n = order * order, receivers = 30, first = 5;
  constexpr std::size_t firstValue = 10, firstPlace = 3;  // Green and blue: values 9 to 17 and 18 to 26.
  std::mt19937 random(2);
  std::vector<float> transfer((firstPlace + 12) * width);
  for (float& t : transfer) t = std::uniform_real_distribution<float>(-1, 1)(random);
  std::vector<Sender> senders((first + receivers) * raysPerReceiver);
  for (Sender& s : senders)
    s = {random() % 3 == 0 ? PRELIGHT_NO_TRIANGLE : static_cast<std::uint32_t>(random() % 12),
         static_cast<std::uint32_t>(random()) & 0x3fffffffu};
  const CastParameters parameters{receivers, raysPerReceiver, 4 + n, scene_.vertexCount(), first, 0.0f, 0.0f,
                                  0.0f};
  Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  Buffer<Sender> senderBuffer(device, std::span<const Sender>(senders));
  Buffer<float> transferBuffer(device, std::span<const float>(transfer));
  Buffer<float> values(device, receivers * width);
  launchOnce(device, "cast/transport_kernels.cl",
             tracer.surfaceOptions()
                 .define("PRELIGHT_COLUMNS", order * order)
                 .define("PRELIGHT_PART_VALUES", GetParam()),
             "gatherBounce", receivers, parameterBuffer, static_cast<std::uint32_t>(firstValue),
             static_cast<std::uint32_t>(firstPlace), senderBuffer, transferBuffer, values);
  const auto result = values.read();
  for (std::size_t r = 0; r < receivers; ++r)
    for (std::size_t i = 0; i < width; ++i) {
      const std::size_t c = (firstValue + i) / n;
      ASSERT_LT(c, 3u);
      double expected = 0.0;
      for (std::size_t j = 0; j < raysPerReceiver; ++j) {
        const Sender& s = senders[(first + r) * raysPerReceiver + j];
        if (s.vertex == PRELIGHT_NO_TRIANGLE) continue;
        expected += ((s.albedo >> (10 * c)) & 1023u) / 1023.0 *
                    double(transfer[(firstPlace + s.vertex) * width + i]) / raysPerReceiver;
      }
      EXPECT_NEAR(result[r * width + i], expected, 2e-6);
    }
}

}  // namespace
}  // namespace prelight
