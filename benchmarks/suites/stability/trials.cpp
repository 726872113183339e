#include "benchmarks/suites/stability/trials.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <numbers>

namespace prelight::benchmarks::stability {

void Differences::add(double got, double truth, double scale) {
  ++values_;
  if (!std::isfinite(got)) {
    ++notFinite_;
    return;
  }
  const double off = std::abs(got - truth);
  absolute_ = std::max(absolute_, off);
  relative_ = std::max(relative_, off / std::max(scale, leastScale));
}

void Trials::record(std::string stress, const Differences& differences, double bound, Growth growth) {
  if (progress_.stopRequested()) throw Interrupted();
  trials_.push_back({subject_, std::move(stress), std::move(growth), differences, bound});
}

glm::dvec3 Random::direction() {
  const double z = between(-1.0, 1.0), turn = 2.0 * std::numbers::pi * unit();
  const double ring = std::sqrt(std::max(1.0 - z * z, 0.0));
  return {ring * std::cos(turn), ring * std::sin(turn), z};
}

std::vector<float> Random::floats(std::size_t count, double scale) {
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(between(-scale, scale));
  return values;
}

namespace {

double share(const Trial& trial) {
  if (trial.differences.relative() == 0.0) return 0.0;
  return trial.bound > 0.0 ? trial.differences.relative() / trial.bound : 1e300;
}

std::string placeOf(const Trial& trial) {
  return trial.growth.parameter.empty()
             ? trial.stress
             : fmt::format("{}; {} {:g}", trial.stress, trial.growth.parameter, trial.growth.at);
}

}  // namespace

std::string worstTable(const std::vector<Trial>& trials) {
  std::string table =
      "| subject | worst relative error | its bound | worst absolute error | where it comes nearest to its "
      "bound | values | not finite |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Subject& subject : subjects()) {
    const Trial* nearest = nullptr;
    double absolute = 0.0;
    std::size_t values = 0, notFinite = 0;
    for (const Trial& trial : trials) {
      if (trial.subject != subject.name) continue;
      if (nearest == nullptr || share(trial) > share(*nearest)) nearest = &trial;
      absolute = std::max(absolute, trial.differences.absolute());
      values += trial.differences.values();
      notFinite += trial.differences.notFinite();
    }
    if (nearest == nullptr) continue;
    table += fmt::format("| {} | {:.2g} | {:.2g} | {:.2g} | {} | {} | {} |\n", subject.name,
                         nearest->differences.relative(), nearest->bound, absolute, placeOf(*nearest), values,
                         notFinite);
  }
  return table;
}

std::string orderTable(const std::vector<Trial>& trials) {
  std::map<std::string, std::map<double, double>> rows;
  std::map<double, int> orders;
  for (const Trial& trial : trials) {
    if (trial.growth.parameter != "order") continue;
    double& worst = rows[trial.subject][trial.growth.at];
    worst = std::max(worst, trial.differences.relative());
    orders[trial.growth.at] = 1;
  }
  std::string table = "| order |", line = "|---|";
  for (const auto& [order, unused] : orders) {
    table += fmt::format(" {:g} |", order);
    line += "---|";
  }
  table += "\n" + line + "\n";
  for (const Subject& subject : subjects()) {
    const auto row = rows.find(subject.name);
    if (row == rows.end()) continue;
    table += fmt::format("| {} |", subject.name);
    for (const auto& [order, unused] : orders) {
      const auto cell = row->second.find(order);
      table += cell == row->second.end() ? " |" : fmt::format(" {:.1e} |", cell->second);
    }
    table += "\n";
  }
  return table;
}

std::string kernelTable() {
  std::map<std::string, std::vector<std::string>> files;
  for (const Subject& subject : subjects())
    for (const std::string& kernel : subject.kernels) files[kernel].push_back(subject.name);
  std::string table = "| kernel | run by |\n|---|---|\n";
  for (const auto& [kernel, by] : files) table += fmt::format("| `{}` | {} |\n", kernel, fmt::join(by, ", "));
  return table;
}

std::string makeReport(const std::vector<Trial>& trials, const std::string& device) {
  return fmt::format("## {}\n\n{}\n## Worst relative error by order\n\n{}\n## Kernels\n\n{}", device,
                     worstTable(trials), orderTable(trials), kernelTable());
}

}  // namespace prelight::benchmarks::stability
