#include "radiosity/exchange_solver.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <random>

#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

struct Room {
  CompiledScene scene;
  RadiosityElements elements;
  FormFactors factors;
};

Room roomOf(CompiledScene scene, double patchSize) {
  Room room{std::move(scene), {}, {}};
  room.elements = makeElements(room.scene, patchSize);
  Tracer tracer(room.scene, test::sharedDevice());
  FormFactorCast cast(room.scene, room.elements, tracer, 256, 1);
  Progress progress;
  cast.run(progress);
  room.factors = makeFormFactors(room.elements, cast.counts(), std::uint64_t{1} << 30);
  return room;
}

CompiledScene colouredRoom(float albedo) {
  CompiledScene scene = test::box(1, {0, 0, 0}, {4, 3, 5}, true);
  scene.materials[0].albedo = {albedo, 0.5f * albedo, 0.1f};
  CompiledScene inner = test::box(1, {1, 0.5f, 1}, {2, 1.5f, 2}, false);
  inner.materials[0].albedo = {0.2f, 0.8f, 0.4f};
  test::append(scene, inner);
  return scene;
}

std::vector<glm::vec4> randomLight(std::uint32_t count, const FormFactors& factors) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0.0f, 10.0f);
  std::vector<glm::vec4> light;
  for (std::uint32_t i = 0; i < count; ++i) {
    const glm::vec4 d(unit(random), unit(random), unit(random), 0.0f);
    light.push_back(factors.isCast(i) && i % 7 == 0 ? d : glm::vec4(0.0f));
  }
  return light;
}

/// Irradiance [element][channel] by dense LU in double precision.
Eigen::MatrixXd denseSolution(const Room& room, const std::vector<glm::vec4>& direct) {
  const FormFactors& f = room.factors;
  const auto n = static_cast<Eigen::Index>(f.elementCount());
  const std::vector<glm::vec4> through = transmissionOfElements(room.scene, room.elements, f.elementCount());
  const std::uint32_t perSide = room.elements.perSide();
  Eigen::MatrixXd solution(n, 3);
  for (int c = 0; c < 3; ++c) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd right(n);
    for (std::uint32_t i = 0; i < f.elementCount(); ++i) {
      right[i] = direct[i][c];
      for (std::uint32_t k = f.rowStart[i]; k < f.rowStart[i + 1]; ++k) {
        const double share = double(f.scale[i]) * f.values[k];
        const std::uint32_t j = f.columns[k];
        a(i, j) -= share * f.albedo[j][c];
        if (f.backs) a(i, j < perSide ? j + perSide : j - perSide) -= share * through[j][c];
      }
    }
    solution.col(c) = a.partialPivLu().solve(right);
  }
  return solution;
}

double worstDifference(const std::vector<glm::vec4>& got, const Eigen::MatrixXd& expected) {
  double worst = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < got.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      worst = std::max(worst, std::abs(got[i][c] - expected(static_cast<Eigen::Index>(i), c)));
      mean += expected(static_cast<Eigen::Index>(i), c) / double(3 * got.size());
    }
  return worst / mean;
}

void expectAllMethodsAgree(const Room& room) {
  const ExchangeSystem system(test::sharedDevice().context(), room.scene, room.elements, room.factors);
  const std::vector<glm::vec4> direct = randomLight(system.size(), room.factors);
  const Eigen::MatrixXd expected = denseSolution(room, direct);
  Progress progress;
  for (std::size_t m = 0; m < radiosityMethodNames.size(); ++m) {
    ExchangeSolver solver(system);
    solver.setDirect(direct);
    const SolveReport report = solver.solve(static_cast<RadiosityMethod>(m), 1e-7, 2000.0, progress);
    EXPECT_TRUE(report.converged) << radiosityMethodNames[m];
    EXPECT_LT(worstDifference(solver.irradiance(), expected), 1e-5)
        << radiosityMethodNames[m] << " after " << report.sweeps() << " sweeps";
  }
}

TEST(ExchangeSolver, AllMethods_AgreeWithDenseElimination) {
  expectAllMethodsAgree(roomOf(colouredRoom(0.8f), 0.9));
}

TEST(ExchangeSolver, TranslucentPanel_AgreesWithDenseElimination) {
  CompiledScene scene = colouredRoom(0.7f);
  CompiledScene panel = test::ground(1, 1.0f, 2.2f);
  for (glm::vec3& p : panel.positions) p += glm::vec3(2, 0, 3.5f);
  panel.materials[0].albedo = {0.3f, 0.2f, 0.1f};
  panel.materials[0].diffuseTransmission = {0.2f, 0.5f, 0.6f};
  test::append(scene, panel);
  const Room room = roomOf(scene, 0.9);
  ASSERT_TRUE(room.factors.backs);
  expectAllMethodsAgree(room);
}

TEST(ExchangeSolver, ClosedRoomOfAlbedo99_Converges) {
  CompiledScene scene = test::box(1, {0, 0, 0}, {4, 3, 5}, true);
  scene.materials[0].albedo = glm::vec3(0.99f, 0.9f, 0.5f);
  const Room room = roomOf(scene, 0.9);
  const ExchangeSystem system(test::sharedDevice().context(), room.scene, room.elements, room.factors);
  Progress progress;
  for (std::size_t m = 0; m < radiosityMethodNames.size(); ++m) {
    ExchangeSolver solver(system);
    solver.setDirect(std::vector<glm::vec4>(system.size(), glm::vec4(1, 1, 1, 0)));
    const SolveReport report = solver.solve(static_cast<RadiosityMethod>(m), 1e-4, 2000.0, progress);
    EXPECT_TRUE(report.converged) << radiosityMethodNames[m];
    EXPECT_LT(report.sweeps(), m == 1 ? 200.0 : 1500.0) << radiosityMethodNames[m];
    // Every row sums to 1, so that even light stays even, times 1 / (1 - albedo). The residual times that
    // bounds the error.
    for (const glm::vec4& e : solver.irradiance()) {
      ASSERT_NEAR(e.x / 100.0, 1.0, 2e-4) << radiosityMethodNames[m];
      ASSERT_NEAR(e.y / 10.0, 1.0, 2e-4);
      ASSERT_NEAR(e.z / 2.0, 1.0, 2e-4);
    }
  }
}

TEST(ExchangeSolver, AcceleratedAndSeidel_NeedFewerSweepsThanJacobi) {
  const Room room = roomOf(colouredRoom(0.9f), 0.7);
  const ExchangeSystem system(test::sharedDevice().context(), room.scene, room.elements, room.factors);
  Progress progress;
  std::array<double, 4> sweeps{};
  for (std::size_t m = 0; m < sweeps.size(); ++m) {
    ExchangeSolver solver(system);
    solver.setDirect(randomLight(system.size(), room.factors));
    sweeps[m] = solver.solve(static_cast<RadiosityMethod>(m), 1e-5, 2000.0, progress, true).sweeps();
  }
  EXPECT_LT(sweeps[1], 0.7 * sweeps[0]);
  EXPECT_LT(sweeps[2], 0.7 * sweeps[0]);
}

TEST(ExchangeSolver, WarmStart_GoesOnFromTheLastSolution) {
  const Room room = roomOf(colouredRoom(0.8f), 0.9);
  const ExchangeSystem system(test::sharedDevice().context(), room.scene, room.elements, room.factors);
  Progress progress;
  ExchangeSolver solver(system);
  solver.setDirect(randomLight(system.size(), room.factors));
  const double cold = solver.solve(RadiosityMethod::GaussSeidel, 1e-5, 1000.0, progress).sweeps();
  const double warm = solver.solve(RadiosityMethod::GaussSeidel, 1e-5, 1000.0, progress).sweeps();
  EXPECT_GT(cold, 4.0);
  EXPECT_LE(warm, 2.0);
}

TEST(ExchangeSolver, Darkness_StaysDark) {
  const Room room = roomOf(colouredRoom(0.8f), 1.5);
  const ExchangeSystem system(test::sharedDevice().context(), room.scene, room.elements, room.factors);
  Progress progress;
  ExchangeSolver solver(system);
  solver.setDirect(std::vector<glm::vec4>(system.size(), glm::vec4(0)));
  EXPECT_TRUE(solver.solve(RadiosityMethod::Southwell, 1e-5, 10.0, progress).converged);
  for (const glm::vec4& e : solver.irradiance()) EXPECT_EQ(e, glm::vec4(0));
}

}  // namespace
}  // namespace prelight
