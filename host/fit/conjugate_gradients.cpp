#include "fit/conjugate_gradients.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "base/kept_work.h"
#include "base/threads.h"

namespace prelight {

namespace {

constexpr std::size_t rowRange = 1024;
// Rows that are summed in single precision before they are added to the total.
constexpr std::size_t sumRun = 16;

/// Returns a power of two that scales a column with values up to `largest` to about 1, so that no square
/// leaves the range of single precision.
float scaleOf(float largest) {
  int exponent = 0;
  if (largest > 0.0f && std::isfinite(largest)) std::frexp(largest, &exponent);
  return std::ldexp(1.0f, std::clamp(-exponent, -100, 100));
}

/// Progress for solutions without one.
const Progress nobody;

/// Conjugate gradients for W columns, so that the inner loops have a fixed length.
template <std::size_t W>
class BlockSolver {
 public:
  BlockSolver(const NormalEquations& equations, const SolveLimits& limits)
      : equations_(equations),
        limits_(limits),
        progress_(limits.progress != nullptr ? *limits.progress : nobody),
        rows_(equations.rows()),
        x_(uninitialised(rows_ * W)),
        residual_(uninitialised(rows_ * W)),
        direction_(uninitialised(rows_ * W)),
        image_(uninitialised(rows_ * W)),
        bend_(uninitialised(rows_ * W)),
        partial_((rows_ + rowRange - 1) / rowRange) {}

  /// Replaces the right-hand sides of columns [first, first + count) by solutions. Rows have `columns` in
  /// all.
  void run(std::span<float> values, std::size_t columns, std::size_t first, std::size_t count) {
    const auto place = [&](std::size_t row) { return equations_.slots()[row] * columns + first; };
    const std::array<float, W> scale = scales(values, columns, first, count);
    course_ = Course();
    WorkPart iterations(progress_, "iterations", [this](auto& state) { this->exchange(state); });
    const Course start = course_;
    runTeam(std::clamp<std::size_t>(partial_.size(), 1, limits_.threads), [&](const TeamMember& member) {
      if (!start.begun)
        forRows(member, [&](std::size_t i) {
          std::fill_n(&x_[i * W], W, 0.0f);
          std::fill_n(&direction_[i * W], W, 0.0f);
        });
      member.wait();
      const bool solved = solve(member, start, iterations, [&](std::size_t i, std::size_t c) {
        return c < count ? static_cast<float>(equations_.factor(i) * scale[c] * values[place(i) + c]) : 0.0f;
      });
      // Values that overflowed single precision become 0 below.
      if (!solved) return;
      forRows(member, [&](std::size_t i) {
        for (std::size_t c = 0; c < count; ++c)
          values[place(i) + c] = std::isfinite(x_[i * W + c]) ? x_[i * W + c] / scale[c] : 0.0f;
      });
    });
    if (stopped_) throw Interrupted();
  }

 private:
  using Sums = std::array<double, W>;
  using Vector = std::unique_ptr<float[]>;  ///< [row][column of the block]

  /// State of the iteration.
  struct Course {
    Sums rho{}, goal{};
    int start = 0;       ///< restarts so far
    int left = 0;        ///< iterations left of this start
    bool begun = false;  ///< whether the direction is that of the next iteration
  };

  template <typename State>
  void exchange(State& state) {
    state.value(course_.rho);
    state.value(course_.goal);
    state.value(course_.start);
    state.value(course_.left);
    state.value(course_.begun);
    for (Vector* vector : {&x_, &residual_, &direction_}) state.elements(std::span(vector->get(), rows_ * W));
    state.require(course_.start >= 0 && course_.start < mostStarts && course_.left <= limits_.iterations);
  }

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

  /// Sums over all rows: add(row, sums) adds a row's contribution to one sum per column. The order of
  /// summation does not depend on the number of threads.
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
    member.wait();  // all members have read the parts before they are overwritten
    return sums;
  }

  // Computes image = operator x `of` in two sweeps and returns the sum of their products.
  Sums apply(const TeamMember& member, const Vector& of) {
    forRows(member, [&](std::size_t i) { equations_.bend<W>(i, of.get(), bend_.get()); });
    member.wait();
    return sumOver(member, [&](std::size_t i, std::array<float, W>& sum) {
      equations_.applyRow<W>(i, of.get(), bend_.get(), image_.get());
      for (std::size_t c = 0; c < W; ++c) sum[c] += of[i * W + c] * image_[i * W + c];
    });
  }

  /// Sets residual = right(row, column) - image and returns the sum of its squares over the preconditioner.
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

  // Iterates until the residual is small enough. Two starts suffice, since the true residual cannot fall much
  // below the precision of floats. Returns false when the user has asked to stop.
  template <typename Right>
  bool solve(const TeamMember& member, Course at, WorkPart& iterations, const Right& right) {
    if (!at.begun) {
      at.rho = at.goal = setResidual(member, right, [](std::size_t, std::size_t) { return 0.0f; });
      for (double& sum : at.goal) sum *= limits_.tolerance * limits_.tolerance;
    }
    for (int taken = 0; at.start < mostStarts && (at.begun || !reached(at.rho, at.goal)); ++at.start) {
      if (!at.begun) turn(member, Sums{});
      if (!at.begun) at.left = limits_.iterations;
      at.begun = true;
      for (; at.left > 0 && !reached(at.rho, at.goal); --at.left, ++taken) {
        if (!goesOn(member, at, taken, iterations)) return false;
        at.rho = step(member, at.rho, at.goal);
      }
      if (!limits_.verified) return true;
      apply(member, x_);
      at.rho = setResidual(member, right, [&](std::size_t i, std::size_t c) { return image_[i * W + c]; });
      at.begun = false;
    }
    return true;
  }

  // Returns whether to continue. Only the first member writes, while the others read the vectors. All members
  // stop at the same iteration, the one after that at which the first was asked to, because they wait for
  // each other in every iteration.
  bool goesOn(const TeamMember& member, const Course& at, int taken, WorkPart& iterations) {
    if (member.isFirst()) {
      course_ = at;
      iterations.advance();
      if (progress_.stopRequested() && stopAt_ == never) stopAt_ = taken + 1;
      stopped_ = taken >= stopAt_;
    }
    return taken < stopAt_;
  }

  // Sets direction = preconditioned residual + beta direction.
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

  // Takes a step along the directions. Converged columns do not change, so that a result does not depend on
  // the columns solved beside it.
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

  static constexpr int mostStarts = 2;
  static constexpr int never = std::numeric_limits<int>::max();

  const NormalEquations& equations_;
  const SolveLimits& limits_;
  const Progress& progress_;
  std::size_t rows_;
  Course course_;  ///< as the first member keeps it
  std::atomic<int> stopAt_ = never;
  bool stopped_ = false;
  Vector x_, residual_, direction_, image_, bend_;
  std::vector<Sums> partial_;  ///< [range]
};

/// Solves columns from `first` on in blocks of W while at least `least` are left. `part` keeps the number of
/// solved columns.
template <std::size_t W>
void solveBlocks(const NormalEquations& equations, std::span<float> values, std::size_t columns,
                 std::size_t least, const SolveLimits& limits, WorkPart& part, std::size_t& first) {
  if (columns - first < least) return;
  BlockSolver<W> solver(equations, limits);
  while (columns - first >= least) {
    const std::size_t count = std::min(W, columns - first);
    solver.run(values, columns, first, count);
    first += count;
    part.advance();
  }
}

}  // namespace

void conjugateGradients(const NormalEquations& equations, std::span<float> values, std::size_t columns,
                        const SolveLimits& limits) {
  std::size_t first = 0;
  WorkPart part(limits.progress != nullptr ? *limits.progress : nobody, "solve", [&](auto& state) {
    state.value(first);
    state.elements(values);
    state.require(first <= columns);
  });
  // A block of twelve takes hardly longer than one of eight, because most time goes into finding neighbours.
  solveBlocks<12>(equations, values, columns, 9, limits, part, first);
  solveBlocks<8>(equations, values, columns, 5, limits, part, first);
  solveBlocks<4>(equations, values, columns, 2, limits, part, first);
  solveBlocks<1>(equations, values, columns, 1, limits, part, first);
  part.finish();
}

}  // namespace prelight
