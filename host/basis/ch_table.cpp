#include "basis/ch_table.h"

#include "basis/ch.h"

namespace prelight {

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
