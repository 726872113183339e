#include "benchmarks/suites/skip/measured_row.h"

#include <fmt/format.h>

#include "benchmarks/run/measure.h"

namespace prelight::benchmarks::skip {

namespace {

constexpr std::array<Presence, 3> presences = {Presence::Absent, Presence::Unneeded, Presence::Needed};

/// "1234 / 1234 / 5678" of thousands, or of units.
std::string triple(const MeasuredRow& measured, std::uint64_t Outcome::*count, double unit) {
  std::string text;
  for (const Outcome& outcome : measured.outcomes)
    text += fmt::format("{}{:.{}f}", text.empty() ? "" : " / ", static_cast<double>(outcome.*count) / unit,
                        unit > 1.0 && static_cast<double>(outcome.*count) < 10.0 * unit ? 1 : 0);
  return text;
}

}  // namespace

MeasuredRow measureRow(const Row& row, const Effort& effort, int rounds, const Device& device,
                       const Progress& progress) {
  MeasuredRow measured{row, {}, 1.0};
  std::array<std::vector<double>, 3> seconds;
  std::array<Setting, 3> settings;
  for (const Presence presence : presences) {
    const auto i = static_cast<std::size_t>(presence);
    settings[i] = row.make(presence, effort);
    measured.outcomes[i] = carryOut(settings[i], device, progress);
  }
  for (int round = 0; round < rounds; ++round)
    for (std::size_t turn = 0; turn < settings.size(); ++turn) {
      const std::size_t i = (static_cast<std::size_t>(round) + turn) % settings.size();
      progress.check();
      seconds[i].push_back(carryOut(settings[i], device, progress).cpuSeconds);
    }
  if (rounds == 0) return measured;
  std::vector<double> costs;
  for (std::size_t round = 0; round < seconds[0].size(); ++round)
    costs.push_back(seconds[0][round] > 0.0 ? seconds[1][round] / seconds[0][round] : 1.0);
  measured.cost = median(costs);
  for (std::size_t i = 0; i < settings.size(); ++i) measured.outcomes[i].cpuSeconds = median(seconds[i]);
  return measured;
}

std::string tableOf(const std::vector<MeasuredRow>& rows) {
  std::string text =
      "| feature | present, not needed | rays, thousands | launches | device, MB | processor time, ms | cost "
      "of its presence | values |\n|---|---|---|---|---|---|---|---|\n";
  for (const MeasuredRow& measured : rows) {
    std::string times;
    for (const Outcome& outcome : measured.outcomes)
      times += fmt::format("{}{:.0f}", times.empty() ? "" : " / ", 1000.0 * outcome.cpuSeconds);
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {:.2f} | {} |\n", measured.row.name,
                    measured.row.unneeded, triple(measured, &Outcome::rays, 1e3),
                    triple(measured, &Outcome::launches, 1.0), triple(measured, &Outcome::deviceBytes, 1e6),
                    times, measured.cost, measured.unchanged() ? "the same bits" : "differ");
  }
  return text;
}

}  // namespace prelight::benchmarks::skip
