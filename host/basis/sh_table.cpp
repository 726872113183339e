#include "basis/sh_table.h"

#include <cmath>
#include <numbers>

namespace prelight {

std::vector<float> makeShTable(int order) {
  const auto n = static_cast<std::size_t>(order);
  std::vector<float> table(2 * (n + n * n) + 2, 0.0f);
  double sectoral = std::sqrt(0.25 / std::numbers::pi);
  for (std::size_t m = 0; m < n; ++m) {
    const double dm = static_cast<double>(m);
    // K_m = K_(m-1) sqrt((2m + 1) / 2m); m > 0 also carries sqrt(2), the norm of cos(m phi).
    if (m > 0) sectoral *= std::sqrt((2.0 * dm + 1.0) / (2.0 * dm)) * (m == 1 ? std::numbers::sqrt2 : 1.0);
    table[2 * m] = static_cast<float>(sectoral);
    for (std::size_t l = m + 1; l < n; ++l) {
      const double dl = static_cast<double>(l);
      const double a = std::sqrt((4.0 * dl * dl - 1.0) / (dl * dl - dm * dm));
      const double b = std::sqrt(((dl - 1.0) * (dl - 1.0) - dm * dm) / (4.0 * (dl - 1.0) * (dl - 1.0) - 1.0));
      table[2 * (n + l * n + m)] = static_cast<float>(a);
      table[2 * (n + l * n + m) + 1] = static_cast<float>(l > m + 1 ? a * b : 0.0);
    }
  }
  return table;
}

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

}  // namespace prelight
