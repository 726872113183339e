#include "benchmarks/lab/harmonic_tables.h"

#include <cmath>
#include <numbers>

#include "basis/ch.h"

namespace prelight {

std::vector<float> makeMonicShTable(int order) {
  const auto n = static_cast<std::size_t>(order);
  std::vector<float> table(4 * n * n, 0.0f);
  const auto store = [](double value, float* at) {
    at[0] = static_cast<float>(value);
    at[1] = static_cast<float>(value - at[0]);
  };
  double sectoral = std::sqrt(0.25 / std::numbers::pi);
  for (std::size_t m = 0; m < n; ++m) {
    const auto dm = static_cast<double>(m);
    if (m > 0) sectoral *= std::sqrt((2.0 * dm + 1.0) / (2.0 * dm)) * (m == 1 ? std::numbers::sqrt2 : 1.0);
    double norm = sectoral;
    for (std::size_t l = m; l < n; ++l) {
      const auto dl = static_cast<double>(l);
      const double before = (dl - 1.0) * (dl - 1.0);
      if (l > m) norm *= std::sqrt((4.0 * dl * dl - 1.0) / (dl * dl - dm * dm));
      store(l > m + 1 ? (before - dm * dm) / (4.0 * before - 1.0) : 0.0, &table[4 * (l * n + m)]);
      store(norm, &table[4 * (l * n + m) + 2]);
    }
  }
  return table;
}

std::vector<float> makeChTable(int order) {
  const auto n = static_cast<std::size_t>(order);
  std::vector<float> table(2 * (n + n * n) + 2, 0.0f);
  for (int m = 0; m < order; ++m) {
    table[2 * static_cast<std::size_t>(m)] = static_cast<float>(ch::sectoral(m));
    for (int l = m + 1; l < order; ++l) {
      const ch::Step step = ch::step(l, m);
      float* constants = &table[2 * (n + static_cast<std::size_t>(l * order + m))];
      constants[0] = static_cast<float>(step.up);
      constants[1] = static_cast<float>(step.down);
    }
  }
  return table;
}

std::vector<float> makeMonicChTable(int order) {
  std::vector<float> table(4 * static_cast<std::size_t>(order * order), 0.0f);
  const auto store = [](double value, float* at) {
    at[0] = static_cast<float>(value);
    at[1] = static_cast<float>(value - at[0]);
  };
  for (int m = 0; m < order; ++m) {
    double norm = ch::sectoral(m);
    for (int l = m; l < order; ++l) {
      const ch::Step step = l > m ? ch::step(l, m) : ch::Step();
      if (l > m) norm *= step.up;
      float* constants = &table[4 * static_cast<std::size_t>(l * order + m)];
      store(l > m + 1 ? step.down / (step.up * ch::step(l - 1, m).up) : 0.0, constants);
      store(norm, constants + 2);
    }
  }
  return table;
}

}  // namespace prelight
