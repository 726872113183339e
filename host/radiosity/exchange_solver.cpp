#include "radiosity/exchange_solver.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <type_traits>

#include "base/kept_work.h"
#include "base/spans.h"
#include "shared/radiosity_types.h"

namespace prelight {

namespace {

std::vector<glm::vec4> padded(const std::vector<glm::vec3>& colors) {
  std::vector<glm::vec4> values;
  for (const glm::vec3& color : colors) values.emplace_back(color, 0.0f);
  return values;
}

}  // namespace

std::vector<glm::vec4> transmissionOfElements(const CompiledScene& scene, const RadiosityElements& elements,
                                              std::uint32_t count) {
  std::vector<glm::vec4> values(count, glm::vec4(0.0f));
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const glm::vec4 through(scene.materials[scene.triangleMaterials[t]].diffuseTransmission, 0.0f);
    for (std::uint32_t side = 0; side < count / elements.perSide(); ++side)
      std::fill(values.begin() + side * elements.perSide() + elements.first[t],
                values.begin() + side * elements.perSide() + elements.first[t + 1], through);
  }
  return values;
}

ExchangeSystem::ExchangeSystem(DeviceContext& device, const CompiledScene& scene,
                               const RadiosityElements& elements, const FormFactors& factors)
    : device_(device),
      size_(factors.elementCount()),
      perSide_(elements.perSide()),
      rowStart_(device, spanOf(factors.rowStart)),
      columns_(device, spanOf(factors.columns)),
      values_(device, spanOf(factors.values)),
      scale_(device, spanOf(factors.scale)),
      areas_(device, spanOf(factors.areas)),
      albedo_(device, spanOf(padded(factors.albedo))) {
  const bool translucent = scene.hasDiffuseTransmission() && factors.backs;
  const std::vector<glm::vec4> through =
      translucent ? transmissionOfElements(scene, elements, size_) : std::vector<glm::vec4>();
  transmission_ = Buffer<glm::vec4>(device, spanOf(through));
  for (std::uint32_t i = 0; i < size_; ++i)
    for (int c = 0; c < 3; ++c)
      greatestAlbedo_ =
          std::max(greatestAlbedo_, double(factors.albedo[i][c]) + (translucent ? through[i][c] : 0.0f));
  options_.defineIf(translucent, "PRELIGHT_TRANSLUCENT");
}

namespace {

constexpr const char* file = "radiosity/solve_kernels.cl";
constexpr std::uint32_t elementsPerSum = 256;
constexpr std::uint32_t seidelBlocks = 32;
constexpr double stepsOfALaunch = 2e7;  // elements processed per launch, which takes far less than a second

}  // namespace

ExchangeSolver::ExchangeSolver(const ExchangeSystem& system)
    : system_(system),
      device_(system.device()),
      direct_(device_, system.size()),
      irradiance_(device_, system.size()),
      exitance_(device_, system.size()),
      residual_(device_, system.size()),
      previous_(device_, system.size()),
      unsent_(device_, system.size()),
      sums_(device_, (system.size() + elementsPerSum - 1) / elementsPerSum),
      taken_(device_, 1),
      gather_(device_, file, system.options(), "gatherRows"),
      measure_(device_, file, system.options(), "measureRows"),
      reflect_(device_, file, system.options(), "reflectRows"),
      accelerate_(device_, file, system.options(), "accelerateRows"),
      sum_(device_, file, system.options(), "sumResiduals"),
      rank_(device_, file, system.options(), "rankRows"),
      relax_(device_, file, system.options(), "relaxGreatest"),
      takeUnsendable_(device_, file, system.options(), "takeUnsendable"),
      takeRest_(device_, file, system.options(), "takeRest") {}

void ExchangeSolver::setDirect(const std::vector<glm::vec4>& direct) {
  direct_.write(std::span<const glm::vec4>(direct));
  directNorm_ = norm(direct_);
  if (!started_ || directNorm_ <= 0.0) restart();
}

void ExchangeSolver::restart() {
  irradiance_.write(std::span<const glm::vec4>(direct_.read()));
  started_ = true;
}

void ExchangeSolver::startFrom(const std::vector<glm::vec4>& irradiance) {
  if (directNorm_ > 0.0) irradiance_.write(std::span<const glm::vec4>(irradiance));
}

/// Returns the largest channel of the sum of area x |value|.
double ExchangeSolver::norm(const Buffer<glm::vec4>& values) {
  sum_.launch(sums_.size(), system_.size(), system_.areas(), values, sums_);
  glm::dvec3 total(0.0);
  for (const glm::vec4& sum : sums_.read()) total += glm::dvec3(sum);
  return std::max({total.x, total.y, total.z});
}

void ExchangeSolver::gather(std::uint32_t first, std::uint32_t count) {
  gather_.launch(count, first, count, system_.rowStart(), system_.columns(), system_.values(),
                 system_.scale(), direct_, exitance_, irradiance_, residual_);
}

void ExchangeSolver::reflect(std::uint32_t first, std::uint32_t count) {
  reflect_.launch(count, first, count, system_.perSide(), system_.albedo(), system_.transmission(),
                  irradiance_, exitance_);
}

void ExchangeSolver::measure() {
  measure_.launch(system_.size(), system_.size(), system_.rowStart(), system_.columns(), system_.values(),
                  system_.scale(), direct_, exitance_, irradiance_, residual_);
}

/// Writes or reads the state of the iteration.
template <typename State>
void ExchangeSolver::exchange(State& state, SolveReport& report, bool& measured) {
  state.values(report.curve);
  for (const ResidualPoint& point : report.curve)
    state.requireFinite(std::array{point.sweeps, point.seconds, point.residual});
  state.value(report.converged);
  state.value(measured);
  state.value(residualKnown_);
  state.value(weight_);
  std::vector<Buffer<glm::vec4>*> buffers{&irradiance_, &exitance_, &residual_};
  if (weight_ != 1.0) buffers.push_back(&previous_);
  for (Buffer<glm::vec4>* buffer : buffers) {
    std::vector<glm::vec4> values(buffer->size());
    if constexpr (std::is_same_v<State, StateWriter>) values = buffer->read();
    state.sameSize(values);
    state.requireFinite(numbersOf(values));
    if constexpr (std::is_same_v<State, StateReader>) buffer->write(std::span<const glm::vec4>(values));
  }
}

SolveReport ExchangeSolver::solve(RadiosityMethod method, double tolerance, double maxSweeps,
                                  Progress& progress, bool exactCurve) {
  using Clock = std::chrono::steady_clock;
  SolveReport report;
  const auto start = Clock::now();
  goal_ = tolerance * directNorm_;
  weight_ = 1.0;
  residualKnown_ = false;
  residual_.fill(glm::vec4(0.0f));
  reflect(0, system_.size());
  if (directNorm_ <= 0.0 && norm(irradiance_) <= 0.0) {
    report.converged = true;
    return report;
  }
  bool measured = false;
  WorkPart part(progress, "radiosity", [&](auto& state) { exchange(state, report, measured); });
  const double earlier = report.curve.empty() ? 0.0 : report.curve.back().seconds;
  while (report.sweeps() < maxSweeps && !report.converged) {
    progress.check();
    const double sweeps = report.sweeps() + sweep(method);
    // The change by a Jacobi sweep is the residual before it, and that by a Gauss-Seidel sweep is close to
    // it.
    double residual = norm(residual_);
    measured = exactCurve || method == RadiosityMethod::Southwell ||
               (method == RadiosityMethod::GaussSeidel && residual <= goal_);
    if (measured) {
      measure();
      residual = norm(residual_);
    }
    residualKnown_ = measured;
    report.curve.push_back({sweeps, earlier + std::chrono::duration<double>(Clock::now() - start).count(),
                            residual / std::max(directNorm_, 1e-300)});
    report.converged = residual <= goal_;
    part.advance();
    progress.report(
        "radiosity",
        report.converged
            ? 1.0
            : std::clamp(std::log(std::max(residual / directNorm_, 1e-30)) / std::log(tolerance), 0.0, 1.0));
  }
  part.finish();
  if (!measured) return report;
  // The measured residual is added, which equals one more Jacobi iteration.
  takeRest_.launch(system_.size(), system_.size(), irradiance_, residual_);
  return report;
}

/// Does a sweep that leaves irradiance and exitance consistent. Returns row operations over rows.
double ExchangeSolver::sweep(RadiosityMethod method) {
  switch (method) {
    case RadiosityMethod::Jacobi:
      return jacobi();
    case RadiosityMethod::Chebyshev:
      return chebyshev();
    case RadiosityMethod::GaussSeidel:
      return gaussSeidel();
    case RadiosityMethod::Southwell:
      break;
  }
  return southwell();
}

double ExchangeSolver::jacobi() {
  gather(0, system_.size());
  reflect(0, system_.size());
  return 1.0;
}

double ExchangeSolver::chebyshev() {
  const double bound = std::min(system_.greatestAlbedo(), 0.99999);
  const bool first = weight_ == 1.0;
  if (first) {
    previous_.write(std::span<const glm::vec4>(irradiance_.read()));
    gather(0, system_.size());
    weight_ = 1.0 / (1.0 - 0.5 * bound * bound);
  } else {
    gather(0, system_.size());
    accelerate_.launch(system_.size(), system_.size(), static_cast<float>(weight_), residual_, irradiance_,
                       previous_);
    weight_ = 1.0 / (1.0 - 0.25 * bound * bound * weight_);
  }
  reflect(0, system_.size());
  return 1.0;
}

double ExchangeSolver::gaussSeidel() {
  const std::uint32_t size = std::max<std::uint32_t>(64, (system_.size() + seidelBlocks - 1) / seidelBlocks);
  for (std::uint32_t first = 0; first < system_.size(); first += size) {
    const std::uint32_t count = std::min(size, system_.size() - first);
    gather(first, count);
    reflect(first, count);
  }
  return 1.0;
}

/// Relaxes as many rows as fit in a launch, each at most once.
double ExchangeSolver::southwell() {
  const std::uint32_t n = system_.size(), perSide = system_.perSide();
  if (!residualKnown_) measure();
  rank_.launch(n, n, perSide, system_.areas(), system_.albedo(), system_.transmission(), residual_, unsent_);
  const auto most = static_cast<std::uint32_t>(std::max(16.0, stepsOfALaunch / n));
  std::uint32_t steps = 0;
  while (steps < n) {
    const std::uint32_t launch = std::min(most, n - steps);
    const device::RelaxStep step{n, launch, static_cast<float>(0.1 * goal_ / n), perSide};
    relax_.launch({PRELIGHT_SOUTHWELL_ITEMS, PRELIGHT_SOUTHWELL_ITEMS}, step, system_.rowStart(),
                  system_.columns(), system_.values(), system_.scale(), system_.areas(), system_.albedo(),
                  system_.transmission(), irradiance_, residual_, unsent_, taken_);
    const std::uint32_t taken = taken_.read()[0];
    steps += taken;
    if (taken < launch) break;
  }
  // If no unsent power is worth a step, all rows add their residual.
  if (steps < n) {
    takeRest_.launch(n, n, irradiance_, residual_);
  } else {
    takeUnsendable_.launch(n, n, irradiance_, residual_, unsent_);
  }
  reflect(0, system_.size());
  return steps == 0 ? 1.0 : double(steps) / n;
}

}  // namespace prelight
