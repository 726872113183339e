#include "fit/conjugate_gradients.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/thread_team.h"

namespace prelight {

namespace {

constexpr std::size_t rowRange = 1024;
constexpr std::size_t sumRun = 16;  // rows that are summed in single precision before they join the total

/// A power of two that brings a column whose values are at most `largest` to about 1, so that no square
/// leaves the range of single precision.
float scaleOf(float largest) {
  int exponent = 0;
  if (largest > 0.0f && std::isfinite(largest)) std::frexp(largest, &exponent);
  return std::ldexp(1.0f, std::clamp(-exponent, -100, 100));
}

/// Conjugate gradients for W columns, so that the inner loops have a fixed length.
template <std::size_t W>
class BlockSolver {
 public:
  BlockSolver(const NormalEquations& equations, const SolveLimits& limits)
      : equations_(equations),
        limits_(limits),
        rows_(equations.rows()),
        x_(uninitialised(rows_ * W)),
        residual_(uninitialised(rows_ * W)),
        direction_(uninitialised(rows_ * W)),
        image_(uninitialised(rows_ * W)),
        bend_(uninitialised(rows_ * W)),
        partial_((rows_ + rowRange - 1) / rowRange) {}

  /// Columns [first, first + count) of right sides, which have `columns` in all, become their solutions.
  void run(std::span<float> values, std::size_t columns, std::size_t first, std::size_t count) {
    const auto place = [&](std::size_t row) { return equations_.slots()[row] * columns + first; };
    const std::array<float, W> scale = scales(values, columns, first, count);
    runTeam(std::clamp<std::size_t>(partial_.size(), 1, limits_.threads), [&](const TeamMember& member) {
      forRows(member, [&](std::size_t i) {
        std::fill_n(&x_[i * W], W, 0.0f);
        std::fill_n(&direction_[i * W], W, 0.0f);
      });
      member.wait();
      solve(member, [&](std::size_t i, std::size_t c) {
        return c < count ? static_cast<float>(equations_.factor(i) * scale[c] * values[place(i) + c]) : 0.0f;
      });
      // Sums beyond what single precision holds have no solution: 0 is as good as any, and harms nobody.
      forRows(member, [&](std::size_t i) {
        for (std::size_t c = 0; c < count; ++c)
          values[place(i) + c] = std::isfinite(x_[i * W + c]) ? x_[i * W + c] / scale[c] : 0.0f;
      });
    });
  }

 private:
  using Sums = std::array<double, W>;
  using Vector = std::unique_ptr<float[]>;  ///< [row][column of the block]

  static Vector uninitialised(std::size_t size) { return std::make_unique_for_overwrite<float[]>(size); }

  static std::array<float, W> scales(std::span<const float> values, std::size_t columns, std::size_t first,
                                     std::size_t count) {
    std::array<float, W> largest{};
    for (std::size_t i = first; i < values.size(); i += columns)
      for (std::size_t c = 0; c < count; ++c) largest[c] = std::max(largest[c], std::abs(values[i + c]));
    std::transform(largest.begin(), largest.end(), largest.begin(), scaleOf);
    return largest;
  }

  template <typename Work>
  void forRows(const TeamMember& member, const Work& work) const {
    member.ranges(rows_, rowRange, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) work(r);
    });
  }

  /// Goes through all rows; add(row, sums) adds what a row has to a sum a column. The total comes in an order
  /// that no number of threads changes.
  template <typename Add>
  Sums sumOver(const TeamMember& member, const Add& add) {
    member.ranges(rows_, rowRange, [&](std::size_t begin, std::size_t end) {
      Sums& total = partial_[begin / rowRange];
      total.fill(0.0);
      for (std::size_t run = begin; run < end; run += sumRun) {
        std::array<float, W> few{};
        for (std::size_t r = run; r < std::min(end, run + sumRun); ++r) add(r, few);
        for (std::size_t c = 0; c < W; ++c) total[c] += few[c];
      }
    });
    member.wait();
    Sums sums{};
    for (const Sums& part : partial_)
      for (std::size_t c = 0; c < W; ++c) sums[c] += part[c];
    member.wait();  // the parts may be written again
    return sums;
  }

  // image = operator x `of`, in two sweeps, with the sum of their products.
  Sums apply(const TeamMember& member, const Vector& of) {
    forRows(member, [&](std::size_t i) { equations_.bend<W>(i, of.get(), bend_.get()); });
    member.wait();
    return sumOver(member, [&](std::size_t i, std::array<float, W>& sum) {
      equations_.applyRow<W>(i, of.get(), bend_.get(), image_.get());
      for (std::size_t c = 0; c < W; ++c) sum[c] += of[i * W + c] * image_[i * W + c];
    });
  }

  /// residual = right(row, column) - image; the sums of its squares over the preconditioner.
  template <typename Right, typename Image>
  Sums setResidual(const TeamMember& member, const Right& right, const Image& image) {
    return sumOver(member, [&](std::size_t i, std::array<float, W>& sum) {
      const float inverse = equations_.inverseDiagonal(i);
      for (std::size_t c = 0; c < W; ++c) {
        const float r = right(i, c) - image(i, c);
        residual_[i * W + c] = r;
        sum[c] += r * r * inverse;
      }
    });
  }

  static bool reached(const Sums& rho, const Sums& goal) {
    for (std::size_t c = 0; c < W; ++c)
      if (rho[c] > goal[c]) return false;
    return true;
  }

  // The true residual cannot fall much below what single precision tells from 0: a second start is enough.
  template <typename Right>
  void solve(const TeamMember& member, const Right& right) {
    Sums rho = setResidual(member, right, [](std::size_t, std::size_t) { return 0.0f; }), goal = rho;
    for (double& sum : goal) sum *= limits_.tolerance * limits_.tolerance;
    for (int start = 0; start < 2 && !reached(rho, goal); ++start) {
      turn(member, Sums{});
      for (int left = limits_.iterations; left > 0 && !reached(rho, goal); --left)
        rho = step(member, rho, goal);
      if (!limits_.verified) return;
      apply(member, x_);
      rho = setResidual(member, right, [&](std::size_t i, std::size_t c) { return image_[i * W + c]; });
    }
  }

  // direction = preconditioned residual + beta direction.
  void turn(const TeamMember& member, const Sums& beta) {
    std::array<float, W> factor;
    for (std::size_t c = 0; c < W; ++c) factor[c] = static_cast<float>(beta[c]);
    forRows(member, [&](std::size_t i) {
      const float inverse = equations_.inverseDiagonal(i);
      for (std::size_t c = 0; c < W; ++c)
        direction_[i * W + c] = residual_[i * W + c] * inverse + factor[c] * direction_[i * W + c];
    });
    member.wait();
  }

  // A column that is as close as wanted stays, so that it does not matter which are solved beside it.
  Sums step(const TeamMember& member, const Sums& rho, const Sums& goal) {
    const Sums curvature = apply(member, direction_);
    std::array<float, W> length{};
    for (std::size_t c = 0; c < W; ++c)
      if (rho[c] > goal[c] && curvature[c] > 0.0) length[c] = static_cast<float>(rho[c] / curvature[c]);
    const Sums next = sumOver(member, [&](std::size_t i, std::array<float, W>& sum) {
      const float inverse = equations_.inverseDiagonal(i);
      for (std::size_t c = 0; c < W; ++c) {
        x_[i * W + c] += length[c] * direction_[i * W + c];
        const float r = residual_[i * W + c] - length[c] * image_[i * W + c];
        residual_[i * W + c] = r;
        sum[c] += r * r * inverse;
      }
    });
    Sums beta{};
    for (std::size_t c = 0; c < W; ++c)
      if (rho[c] > goal[c]) beta[c] = next[c] / rho[c];
    turn(member, beta);
    return next;
  }

  const NormalEquations& equations_;
  const SolveLimits& limits_;
  std::size_t rows_;
  Vector x_, residual_, direction_, image_, bend_;
  std::vector<Sums> partial_;  ///< [range]
};

template <std::size_t W>
std::size_t solveBlocks(const NormalEquations& equations, std::span<float> values, std::size_t columns,
                        std::size_t first, std::size_t least, const SolveLimits& limits) {
  if (columns - first < least) return first;
  BlockSolver<W> solver(equations, limits);
  for (; columns - first >= least; first += std::min(W, columns - first))
    solver.run(values, columns, first, std::min(W, columns - first));
  return first;
}

}  // namespace

void conjugateGradients(const NormalEquations& equations, std::span<float> values, std::size_t columns,
                        const SolveLimits& limits) {
  // A block of twelve takes hardly longer than one of eight: the time goes into finding neighbours.
  std::size_t first = solveBlocks<12>(equations, values, columns, 0, 9, limits);
  first = solveBlocks<8>(equations, values, columns, first, 5, limits);
  first = solveBlocks<4>(equations, values, columns, first, 2, limits);
  solveBlocks<1>(equations, values, columns, first, 1, limits);
}

}  // namespace prelight
