#include "radiosity/form_factors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr std::size_t rowGrain = 256;
constexpr int maxBalancings = 40;
constexpr double balanced = 1e-5;
constexpr std::uint32_t noRow = 0xffffffffu;

/// The counts by column.
struct Transposed {
  std::vector<std::uint64_t> offsets;  ///< [element + 1]
  std::vector<std::uint32_t> rows;     ///< elements that the rays came from, ascending
  std::vector<std::uint16_t> counts;
};

Transposed transpose(const ExchangeCounts& counts, std::uint32_t elements) {
  // Rows are visited in ascending order of elements, so that entries of a column ascend, too.
  std::vector<std::uint32_t> order(counts.elements.size());
  for (std::uint32_t r = 0; r < order.size(); ++r) order[r] = r;
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return counts.elements[a] < counts.elements[b]; });
  Transposed t;
  t.offsets.assign(elements + 1, 0);
  for (const std::uint32_t column : counts.columns) ++t.offsets[column + 1];
  for (std::uint32_t e = 0; e < elements; ++e) t.offsets[e + 1] += t.offsets[e];
  t.rows.resize(counts.columns.size());
  t.counts.resize(counts.columns.size());
  std::vector<std::uint64_t> next(t.offsets.begin(), t.offsets.end() - 1);
  for (const std::uint32_t r : order)
    for (std::uint64_t i = counts.offsets[r]; i < counts.offsets[r + 1]; ++i) {
      const std::uint64_t at = next[counts.columns[i]]++;
      t.rows[at] = counts.elements[r];
      t.counts[at] = counts.counts[i];
    }
  return t;
}

/// Calls entry(column, count) for the sum of an element's counts in both directions, in ascending order.
template <typename Entry>
void mergeRow(const ExchangeCounts& counts, std::uint32_t row, const Transposed& other, std::uint32_t element,
              const Entry& entry) {
  std::uint64_t a = counts.offsets[row], b = other.offsets[element];
  const std::uint64_t endA = counts.offsets[row + 1], endB = other.offsets[element + 1];
  while (a < endA || b < endB) {
    const std::uint32_t ca = a < endA ? counts.columns[a] : noRow, cb = b < endB ? other.rows[b] : noRow;
    const std::uint32_t column = std::min(ca, cb);
    std::uint32_t count = 0;
    if (ca == column) count += counts.counts[a++];
    if (cb == column) count += other.counts[b++];
    entry(column, count);
  }
}

/// Scales S symmetrically until rows sum to area x (1 - escaped).
void balance(FormFactors& f) {
  const std::uint32_t n = f.elementCount();
  std::vector<double> factor(n, 1.0), step(n, 1.0);
  double worst = 1.0;
  for (int round = 0; round < maxBalancings && worst > balanced; ++round) {
    parallelRanges(n, rowGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        double sum = 0.0;
        for (std::uint32_t k = f.rowStart[i]; k < f.rowStart[i + 1]; ++k)
          sum += f.values[k] * factor[f.columns[k]];
        const double wanted = double(f.areas[i]) * (1.0 - double(f.escaped[i]));
        step[i] = sum > 0.0 && wanted > 0.0 ? wanted / (sum * factor[i]) : 1.0;
      }
    });
    worst = 0.0;
    for (std::uint32_t i = 0; i < n; ++i) {
      worst = std::max(worst, std::abs(step[i] - 1.0));
      factor[i] *= std::sqrt(step[i]);
    }
  }
  parallelRanges(n, rowGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::uint32_t k = f.rowStart[i]; k < f.rowStart[i + 1]; ++k)
        f.values[k] = static_cast<float>(f.values[k] * factor[i] * factor[f.columns[k]]);
  });
}

/// Sets the scales such that every row has its exact sum in spite of rounding.
void setScales(FormFactors& f) {
  for (std::uint32_t i = 0; i < f.elementCount(); ++i) {
    double sum = 0.0;
    for (std::uint32_t k = f.rowStart[i]; k < f.rowStart[i + 1]; ++k) sum += f.values[k];
    if (f.areas[i] <= 0.0f) continue;
    const double wanted = 1.0 - double(f.escaped[i]);
    f.scale[i] = static_cast<float>(sum > 0.0 && wanted > 0.0 ? wanted / sum : 1.0 / double(f.areas[i]));
  }
}

}  // namespace

FormFactors makeFormFactors(const RadiosityElements& elements, const ExchangeCounts& counts,
                            std::uint64_t maxMemory) {
  const std::uint32_t all = 2 * elements.perSide();
  FormFactors f;
  // A translucent back is cast from even if no ray has hit it from behind.
  const auto isBack = [&](std::uint32_t element) { return element >= elements.perSide(); };
  f.backs = std::any_of(counts.columns.begin(), counts.columns.end(), isBack) ||
            std::any_of(counts.elements.begin(), counts.elements.end(), isBack);
  const std::uint32_t n = f.backs ? all : elements.perSide();
  std::vector<std::uint32_t> rowOf(all, noRow);
  f.areas.assign(n, 0.0f);
  f.escaped.assign(n, 0.0f);
  f.albedo.assign(n, glm::vec3(0.0f));
  f.scale.assign(n, 0.0f);
  std::vector<double> density(all, 0.0);  // rays per m2
  for (std::uint32_t r = 0; r < counts.elements.size(); ++r) {
    const std::uint32_t e = counts.elements[r];
    if (counts.rays[r] == 0) continue;
    rowOf[e] = r;
    f.areas[e] = elements.areas[elements.triangleOf(e)] * counts.surface[r].w;
    f.albedo[e] = glm::vec3(counts.surface[r]);
    f.escaped[e] = static_cast<float>(double(counts.escaped[r]) / counts.rays[r]);
    density[e] = counts.rays[r] / double(f.areas[e]);
  }
  const Transposed other = transpose(counts, all);
  f.rowStart.assign(n + 1, 0);
  std::vector<std::uint64_t> sizes(n, 0);
  parallelRanges(n, rowGrain, [&](std::size_t begin, std::size_t end) {
    for (auto e = static_cast<std::uint32_t>(begin); e < end; ++e)
      if (rowOf[e] != noRow)
        mergeRow(counts, rowOf[e], other, e, [&](std::uint32_t, std::uint32_t) { ++sizes[e]; });
  });
  std::uint64_t total = 0;
  for (std::uint32_t e = 0; e < n; ++e) {
    total += sizes[e];
    if (total > 0xffffffffu || 8 * total > maxMemory)
      throw Error(ExitCode::OutOfMemory, "form factors",
                  fmt::format("more than {} MB of them", (8 * total) >> 20),
                  "raise RadiosityRequest::patchSize, lower Effort::rays, or raise BakeRequest::maxMemory");
    f.rowStart[e + 1] = static_cast<std::uint32_t>(total);
  }
  f.columns.resize(total);
  f.values.resize(total);
  parallelRanges(n, rowGrain, [&](std::size_t begin, std::size_t end) {
    for (auto e = static_cast<std::uint32_t>(begin); e < end; ++e) {
      if (rowOf[e] == noRow) continue;
      std::uint32_t k = f.rowStart[e];
      mergeRow(counts, rowOf[e], other, e, [&](std::uint32_t column, std::uint32_t count) {
        f.columns[k] = column;
        f.values[k++] = static_cast<float>(count / (density[e] + density[column]));
      });
    }
  });
  balance(f);
  setScales(f);
  return f;
}

}  // namespace prelight
