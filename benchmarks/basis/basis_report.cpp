// Prints the tables of docs/notes/bases.md, or the SH coefficients of a sky, to compare with other programs:
//   prelight_basis_report
//   prelight_basis_report SKY.exr ORDER     a line per coefficient: index, R, G, B
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "basis/ch.h"
#include "basis/quadrature.h"
#include "basis/lights/sh_lights.h"
#include "basis/sh.h"
#include "prelight/error.h"
#include "prelight/picture.h"
#include "tables.h"

namespace prelight {
namespace {

double norm(const std::vector<double>& f) {
  double square = 0.0;
  for (const double v : f) square += v * v;
  return std::sqrt(square);
}

double distance(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return norm(a);
}

/// Returns the SH coefficients of the function that results if moments are used as coefficients.
std::vector<double> naive(const ch::Basis& basis, const std::vector<double>& sh) {
  std::vector<double> out(sh.size());
  basis.momentsFromSh(sh, out);
  basis.toSh(out, out);
  return out;
}

std::vector<double> dual(const ch::Basis& basis, const std::vector<double>& sh) {
  std::vector<double> out(sh.size());
  basis.momentsFromSh(sh, out);
  basis.dualFromMoments(out, out);
  basis.toSh(out, out);
  return out;
}

struct TestFunction {
  std::string name;
  double square = 0.0;  ///< integral of f^2 over the sphere
  std::function<std::vector<double>(int order)> project;
};

std::vector<TestFunction> testFunctions() {
  const double pi = std::numbers::pi;
  const auto clamped = [](const glm::dvec3& n) {
    return [n](int order) {
      std::vector<double> f(sh::coefficientCount(order));
      sh::openTransfer(glm::normalize(n), order, f);
      for (double& v : f) v *= std::numbers::pi;
      return f;
    };
  };
  const auto cap = [](int order) {
    std::vector<double> f(sh::coefficientCount(order));
    sh::capLight(glm::normalize(glm::dvec3(1.0, 2.0, 3.0)), 0.5, order, f);
    return f;
  };
  const auto constant = [](int order) {
    std::vector<double> f(sh::coefficientCount(order), 0.0);
    f[0] = std::sqrt(4.0 * std::numbers::pi);
    return f;
  };
  return {{"constant", 4.0 * pi, constant},
          {"clamped cosine, z", 2.0 * pi / 3.0, clamped({0.0, 0.0, 1.0})},
          {"clamped cosine, x", 2.0 * pi / 3.0, clamped({1.0, 0.0, 0.0})},
          {"clamped cosine, (1, 1, 1)", 2.0 * pi / 3.0, clamped({1.0, 1.0, 1.0})},
          {"cap of 0.5 rad", 2.0 * pi * (1.0 - std::cos(0.5)), cap}};
}

/// Returns the eigenvalues of the Gram matrix G. The norm of E = G - 1 is the worst case of the naive
/// projection.
Eigen::VectorXd gramEigenvalues(const ch::Basis& basis) {
  const int count = sh::coefficientCount(basis.order());
  Eigen::MatrixXd gram(count, count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) gram(i, j) = basis.gram(i, j);
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram, Eigen::EigenvaluesOnly).eigenvalues();
}

/// Returns the largest |<C_i, C_j>| off the diagonal.
double largestOverlap(const ch::Basis& basis) {
  double worst = 0.0;
  for (int i = 0; i < sh::coefficientCount(basis.order()); ++i) {
    for (int j = 0; j < i; ++j) worst = std::max(worst, std::abs(basis.gram(i, j)));
  }
  return worst;
}

void printChTable() {
  fmt::print(
      "CH: the Gram matrix; naive error as a part of the function's norm, worst case and root mean square "
      "over\n"
      "all functions of the span; round trip SH, moments, dual, SH of random coefficients\n\n");
  fmt::print(
      "| order | coefficients | condition | lambda min | lambda max | largest overlap | naive, worst | "
      "naive, rms "
      "| dual round trip |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const int order : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 16, 20, 24, 28, 32}) {
    const ch::Basis basis(order);
    const Eigen::VectorXd eigenvalues = gramEigenvalues(basis);
    // Naive reconstruction maps y to B^T B y, whose eigenvalues are those of the Gram matrix B B^T.
    const Eigen::ArrayXd error = eigenvalues.array() - 1.0;
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<double> y(sh::coefficientCount(order));
    for (double& v : y) v = normal(random);
    fmt::print("| {} | {} | {:.2f} | {:.3f} | {:.3f} | {:.3f} | {:.1f} % | {:.1f} % | {:.1e} |\n", order,
               order * order, eigenvalues.tail(1)(0) / eigenvalues(0), eigenvalues(0), eigenvalues.tail(1)(0),
               largestOverlap(basis), 100.0 * error.abs().maxCoeff(),
               100.0 * std::sqrt(error.square().mean()), distance(dual(basis, y), y) / norm(y));
  }
  fmt::print("\n");
}

void printChReconstruction() {
  fmt::print(
      "CH and SH: L2 error of the reconstruction as a part of the function's norm: SH = CH dual / CH naive, "
      "and\n"
      "the largest difference between SH and CH dual\n\n| order |");
  const auto functions = testFunctions();
  for (const TestFunction& f : functions) fmt::print(" {} |", f.name);
  fmt::print(" SH - dual |\n|---|---|---|---|---|---|---|\n");
  for (const int order : {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 16, 20, 24, 28, 32}) {
    const ch::Basis basis(order);
    fmt::print("| {} |", order);
    double worst = 0.0;
    for (const TestFunction& f : functions) {
      const auto y = f.project(order);
      // The truncated bands are orthogonal to every reconstruction of this order.
      const double truncated = std::max(0.0, f.square - norm(y) * norm(y));
      const double wrong = distance(naive(basis, y), y);
      fmt::print(" {:.2f} / {:.1f} % |", 100.0 * std::sqrt(truncated / f.square),
                 100.0 * std::sqrt((truncated + wrong * wrong) / f.square));
      worst = std::max(worst, distance(dual(basis, y), y) / norm(y));
    }
    fmt::print(" {:.1e} |\n", worst);
  }
  fmt::print("\n");
}

void printSky(const char* file, int order) {
  const auto sky = sh::projectEnvironment(readEnvironment(file), order);
  const std::size_t count = sh::coefficientCount(order);
  for (std::size_t i = 0; i < count; ++i) {
    fmt::print("{} {:.17g} {:.17g} {:.17g}\n", i, sky[i], sky[count + i], sky[2 * count + i]);
  }
}

void printTables() {
  printOrthonormality(Device::open({}));
  printRotationDrift();
  printRotationTimes();
  printChTable();
  printChReconstruction();
  printBallShadows();
}

}  // namespace
}  // namespace prelight

int main(int argc, char** argv) {
  try {
    if (argc == 3) {
      prelight::printSky(argv[1], std::atoi(argv[2]));
    } else if (argc == 1) {
      prelight::printTables();
    } else {
      fmt::print(stderr, "usage: prelight_basis_report [SKY ORDER]\n");
      return 2;
    }
  } catch (const prelight::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
