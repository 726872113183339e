#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <vector>

#include "basis/quadrature.h"
#include "basis/sh.h"
#include "basis/sh_evaluate.h"
#include "benchmarks/lab/ball_shadow.h"
#include "benchmarks/lab/sh_device.h"
#include "tables.h"

namespace prelight {
namespace {

constexpr int reportedOrders[] = {1, 2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 20, 24, 28, 32};

/// Largest difference of <Y_i, Y_j> from 1 or 0, and of values from those in double precision. `values` is
/// [i][direction].
struct BasisError {
  double gram = 0.0;
  double value = 0.0;
};

BasisError errorOf(const std::vector<double>& values, const std::vector<SphereSample>& samples, int order) {
  BasisError error;
  const int count = sh::coefficientCount(order);
  const std::size_t n = samples.size();
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = 0.0;
      for (std::size_t d = 0; d < n; ++d) sum += samples[d].weight * values[i * n + d] * values[j * n + d];
      error.gram = std::max(error.gram, std::abs(sum - (i == j ? 1.0 : 0.0)));
    }
  }
  std::vector<double> exact(count);
  const double largest = std::sqrt((2.0 * order - 1.0) / 12.566370614359172);
  for (std::size_t d = 0; d < n; ++d) {
    sh::evaluate(samples[d].direction, order, exact);
    for (int i = 0; i < count; ++i) {
      error.value = std::max(error.value, std::abs(values[i * n + d] - exact[i]) / largest);
    }
  }
  return error;
}

std::vector<double> onHost(const std::vector<SphereSample>& samples, int order) {
  std::vector<double> values(samples.size() * sh::coefficientCount(order));
  std::vector<double> one(sh::coefficientCount(order));
  for (std::size_t d = 0; d < samples.size(); ++d) {
    sh::evaluate(samples[d].direction, order, one);
    for (std::size_t i = 0; i < one.size(); ++i) values[i * samples.size() + d] = one[i];
  }
  return values;
}

/// Returns values by the recurrence of kernels/project/sh_funcs.cl, which bakes use, in float on the host.
std::vector<double> byBakeRecurrence(const std::vector<SphereSample>& samples, int order) {
  const std::vector<float> table = makeShTable(order);
  std::vector<double> values(samples.size() * sh::coefficientCount(order));
  for (std::size_t d = 0; d < samples.size(); ++d) {
    const glm::vec3 w(samples[d].direction);
    float cosine = 1.0f;
    float sine = 0.0f;
    for (int m = 0; m < order; ++m) {
      if (m > 0) {
        const float next = cosine * w.x - sine * w.y;
        sine = sine * w.x + cosine * w.y;
        cosine = next;
      }
      float before = 0.0f;
      float value = table[2 * m];
      for (int l = m; l < order; ++l) {
        if (l > m) {
          const int at = 2 * (order + l * order + m);
          const float next = table[at] * w.z * value - table[at + 1] * before;
          before = value;
          value = next;
        }
        values[(l * (l + 1) + m) * samples.size() + d] = value * cosine;
        if (m > 0) values[(l * (l + 1) - m) * samples.size() + d] = value * sine;
      }
    }
  }
  return values;
}

std::vector<double> onDevice(const Device& device, const std::vector<SphereSample>& samples, int order) {
  std::vector<glm::vec3> directions;
  for (const SphereSample& s : samples) directions.emplace_back(s.direction);
  const auto values = sh::evaluateOnDevice(device, directions, order);
  return {values.begin(), values.end()};
}

std::vector<double> unitCoefficients(int order) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  std::vector<double> f(sh::coefficientCount(order));
  double square = 0.0;
  for (double& v : f) {
    v = normal(random);
    square += v * v;
  }
  for (double& v : f) v /= std::sqrt(square);
  return f;
}

/// Returns the distance between a unit function that is turned `count` times and one that is turned once by
/// the product.
template <typename Number>
double drift(int order, int count,
             const std::function<void(const sh::ShRotation&, std::vector<Number>&)>& apply) {
  std::mt19937 random(5);
  const auto f = unitCoefficients(order);
  std::vector<Number> values(f.begin(), f.end());
  glm::dmat3 total(1.0);
  for (int i = 0; i < count; ++i) {
    const glm::dmat3 rotation = randomRotation(random);
    apply(sh::ShRotation(order, rotation), values);
    total = rotation * total;
  }
  std::vector<double> expected(f.size());
  sh::ShRotation(order, total).apply(f, expected);
  double square = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i)
    square += std::pow(static_cast<double>(values[i]) - expected[i], 2);
  return std::sqrt(square);
}

/// Turns f as a device does: by the matrices of its bands, rounded to float, with sums in float.
void applyInFloat(const sh::ShRotation& rotation, std::vector<float>& f) {
  for (int l = 0; l < rotation.order(); ++l) {
    const auto matrix = rotation.bandMatrix(l);
    const int width = 2 * l + 1;
    const std::vector<float> before(f.begin() + l * l, f.begin() + l * l + width);
    for (int m = 0; m < width; ++m) {
      float sum = 0.0f;
      for (int k = 0; k < width; ++k) sum += static_cast<float>(matrix[m * width + k]) * before[k];
      f[l * l + m] = sum;
    }
  }
}

double projectionDifference(int order) {
  std::mt19937 random(4);
  const glm::dmat3 rotation = randomRotation(random);
  const auto f = [](const glm::dvec3& w) { return std::exp(2.0 * w.x - w.y) * std::sin(3.0 * w.z + 1.0); };
  const auto turned = [&](const glm::dvec3& w) { return f(glm::transpose(rotation) * w); };
  std::vector<double> rotated(sh::coefficientCount(order));
  sh::ShRotation(order, rotation).apply(sh::project(f, 80, order), rotated);
  const auto expected = sh::project(turned, 80, order);
  double worst = 0.0;
  for (std::size_t i = 0; i < rotated.size(); ++i)
    worst = std::max(worst, std::abs(rotated[i] - expected[i]));
  return worst;
}

/// Returns the processor time of a call in microseconds.
double microseconds(int repeats, const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  for (int i = 0; i < repeats; ++i) work();
  return 1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / repeats;
}

}  // namespace

glm::dmat3 randomRotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const glm::dvec4 q =
      glm::normalize(glm::dvec4(normal(random), normal(random), normal(random), normal(random)));
  const glm::dvec3 v(q);
  const glm::dmat3 cross(0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0);
  return glm::dmat3(1.0) + 2.0 * q.w * cross + 2.0 * cross * cross;
}

void printOrthonormality(const Device& device) {
  fmt::print(
      "Orthonormality: largest |<Y_i, Y_j> - (i == j)|, and largest error of a value over the largest "
      "value\n\n");
  fmt::print(
      "| order | double, Gram | device float, Gram | device float, values | bake's recurrence, Gram | bake's "
      "recurrence, values |\n|---|---|---|---|---|---|\n");
  for (const int order : reportedOrders) {
    const auto samples = sphereQuadrature(2 * order - 2);
    const BasisError host = errorOf(onHost(samples, order), samples, order);
    const BasisError kernel = errorOf(onDevice(device, samples, order), samples, order);
    const BasisError bake = errorOf(byBakeRecurrence(samples, order), samples, order);
    fmt::print("| {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |\n", order, host.gram, kernel.gram,
               kernel.value, bake.gram, bake.value);
  }
  fmt::print("\n");
}

void printRotationDrift() {
  fmt::print(
      "Rotation: rotated projection against projection of the rotated function; distance after many "
      "rotations\n"
      "from the one by their product, for a function of norm 1\n\n");
  fmt::print(
      "| order | one rotation | 1000, double | 1000, stored as float | 10 000, stored as float | 1000, all "
      "in float "
      "|\n|---|---|---|---|---|---|\n");
  const auto inDouble = [](const sh::ShRotation& rotation, std::vector<double>& f) { rotation.apply(f, f); };
  const auto stored = [](const sh::ShRotation& rotation, std::vector<float>& f) {
    rotation.apply(std::span<const float>(f), std::span<float>(f));
  };
  for (const int order : {2, 3, 6, 14, 32}) {
    fmt::print("| {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |\n", order, projectionDifference(order),
               drift<double>(order, 1000, inDouble), drift<float>(order, 1000, stored),
               drift<float>(order, 10000, stored), drift<float>(order, 1000, applyInFloat));
  }
  fmt::print("\n");
}

void printRotationTimes() {
  fmt::print(
      "Time of a rotation, relative to ShRotation::apply\n\n| order | prepare | apply | by quadrature |\n"
      "|---|---|---|---|\n");
  for (const int order : {3, 6, 14}) {
    std::mt19937 random(1);
    const glm::dmat3 matrix = randomRotation(random);
    const sh::ShRotation rotation(order, matrix);
    auto f = unitCoefficients(order);
    const double apply = microseconds(20000, [&] { rotation.apply(f, f); });
    const double prepare = microseconds(20000, [&] { sh::ShRotation(order, matrix).apply(f, f); }) - apply;
    const double slow = microseconds(20, [&] { sh::rotate(f, order, matrix); });
    fmt::print("| {} | {:.1f} | 1 | {:.0f} |\n", order, prepare / apply, slow / apply);
  }
  fmt::print("\n");
}

void printBallShadows() {
  fmt::print("\n| order | point | 20 degrees | 40 degrees |\n|---|---|---|---|\n");
  for (const int order : {2, 3, 4, 5, 6, 8, 10, 16, 24}) {
    fmt::print("| {} |", order);
    for (const double degrees : {0.0, 20.0, 40.0})
      fmt::print(" {:.3f} |", ball_shadow::error(degrees * 0.017453292519943295, order));
    fmt::print("\n");
  }
}

}  // namespace prelight
