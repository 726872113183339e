#include "benchmarks/lab/harmonic_sums.h"

#include <array>
#include <cmath>
#include <cstdlib>

#include "basis/ch.h"
#include "basis/sh_evaluate.h"
#include "benchmarks/lab/harmonic_tables.h"
#include "benchmarks/lab/lab_kernels.h"

namespace prelight {

namespace {

constexpr std::uint32_t lanes = 8;

/// Returns the value of the macro PRELIGHT_HARMONICS.
int macroOf(HarmonicWay way) {
  if (way == HarmonicWay::ChPlain) return 2;
  return way == HarmonicWay::ShMonic || way == HarmonicWay::ChMonic ? 1 : 0;
}

/// Returns [l order + m][4], see makeMonicShTable().
std::vector<float> monicTable(HarmonicWay way, int order) {
  return way == HarmonicWay::ShMonic ? makeMonicShTable(order) : makeMonicChTable(order);
}

std::vector<float> tableOf(HarmonicWay way, int order) {
  if (way == HarmonicWay::Sh) return makeShTable(order);
  if (way == HarmonicWay::Ch) return makeChTable(order);
  if (way == HarmonicWay::ChPlain) return {0.0f};
  std::vector<float> squares;
  const std::vector<float> constants = monicTable(way, order);
  for (std::size_t i = 0; i < constants.size(); i += 4) squares.push_back(constants[i]);
  return squares;
}

/// Returns the norm of T_l^(m) / T_m^(m). For m = 0 the kernel holds twice T_l.
double plainNorm(int l, int m) {
  double derivative = 0.5;  // T_m^(m) = 2^(m-1) m!
  for (int i = 1; i <= m; ++i) derivative *= 2.0 * i;
  return ch::constant(l, m) * derivative;
}

std::vector<float> normsOf(HarmonicWay way, int order) {
  std::vector<float> norms(static_cast<std::size_t>(order * order), 1.0f);
  if (macroOf(way) == 0) return norms;
  const std::vector<float> constants =
      way == HarmonicWay::ChPlain ? std::vector<float>() : monicTable(way, order);
  for (int l = 0; l < order; ++l)
    for (int m = -l; m <= l; ++m) {
      const int k = std::abs(m);
      norms[static_cast<std::size_t>(l * (l + 1) + m)] =
          way == HarmonicWay::ChPlain ? static_cast<float>(plainNorm(l, k))
                                      : constants[4 * static_cast<std::size_t>(l * order + k) + 2];
    }
  return norms;
}

std::vector<float> inLanes(std::span<const WeightedDirection> directions) {
  std::vector<float> packed(directions.size() * 4);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    float* group = &packed[i / lanes * lanes * 4 + i % lanes];
    for (int axis = 0; axis < 3; ++axis) group[axis * static_cast<int>(lanes)] = directions[i].towards[axis];
    group[3 * lanes] = directions[i].weight;
  }
  return packed;
}

}  // namespace

std::span<const HarmonicWayName> harmonicWays() {
  static constexpr std::array<HarmonicWayName, 5> ways = {{{HarmonicWay::Sh, "SH, two constants", false},
                                                           {HarmonicWay::Ch, "CH, two constants", true},
                                                           {HarmonicWay::ShMonic, "SH, one constant", false},
                                                           {HarmonicWay::ChMonic, "CH, one constant", true},
                                                           {HarmonicWay::ChPlain, "CH, no constants", true}}};
  return ways;
}

int harmonicOperations(HarmonicWay way, int order) {
  const int waves = 4 * (order - 1), additions = order * order;
  const int steps = order * (order - 1) / 2;  // from a band to the next
  if (macroOf(way) == 0) return waves + additions + 3 * steps;
  if (macroOf(way) == 1) return waves + additions + 2 * steps;
  return waves + additions + 2 * steps - (order - 1) + 1;
}

HarmonicSums::HarmonicSums(DeviceContext& device, HarmonicWay way, int order,
                           std::span<const WeightedDirection> directions)
    : device_(device),
      blocks_(static_cast<std::uint32_t>(directions.size() / blockSize)),
      table_(device, std::span<const float>(tableOf(way, order))),
      norms_(device, std::span<const float>(normsOf(way, order))),
      directions_(device, std::span<const float>(inLanes(directions))),
      sums_(device, std::size_t{blocks_} * static_cast<std::size_t>(order * order)),
      kernel_(device, labKernel(device, "harmonic_sum_kernels.cl"),
              BuildOptions().define("PRELIGHT_SH_ORDER", order).define("PRELIGHT_HARMONICS", macroOf(way)),
              "sumHarmonics") {}

void HarmonicSums::run() {
  kernel_.launch({blocks_, 8}, blocks_, blockSize / lanes, table_, norms_, directions_, sums_);
  device_.finish();
}

std::vector<float> HarmonicSums::sums() const { return sums_.read(); }

}  // namespace prelight
