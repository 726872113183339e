#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace prelight::viewer {

/// A rectangle of a picture's samples, from its lower left corner, rows upwards as OpenGL has them.
struct SampleRect {
  int x = 0, y = 0, width = 0, height = 0;

  long area() const { return static_cast<long>(width) * height; }
  bool operator==(const SampleRect&) const = default;
};

/// Cuts a picture into rectangles that take about the same time each, by the time that the last ones took.
/// The first few are small and spread over the picture, to learn what its samples cost; those that follow
/// cover all of it, from the top to the bottom.
class PictureSlices {
 public:
  static constexpr double unbounded = std::numeric_limits<double>::infinity();
  static constexpr int leastSide = 32;  ///< samples, but at a picture's edges
  static constexpr int probes = 5;

  /// `seconds` that a slice may take; unbounded: the whole picture is one slice.
  PictureSlices(int width, int height, double seconds);

  bool isSliced() const { return seconds_ < unbounded; }
  bool done() const { return top_ <= 0; }

  /// The rectangle to draw now. Precondition: !done().
  SampleRect next() const;

  /// It has been drawn, in this time.
  void drew(double seconds);

 private:
  SampleRect probe() const;
  void learn(double seconds, long area);
  double costOf(double seconds, double samples) const;
  double samplesNow() const;
  void startRow();

  int width_, height_;
  double seconds_;
  int probesDrawn_ = 0;
  int top_;       ///< rows from here up are done
  int x_ = 0;     ///< columns of the current row of slices that are done
  int rows_ = 0;  ///< height of the current row of slices
  double overhead_ = std::numeric_limits<double>::infinity();  ///< s, of any slice: the least that one took
  double lastSeconds_ = 0.0, lastSamples_ = 0.0;               ///< of the last slice
  double dearestSeconds_ = 0.0, dearestSamples_ = 1.0;         ///< of the one with the dearest samples
};

/// Chooses at which fraction of a window's size drafts are drawn, so that each takes less than `limit`.
class DraftSize {
 public:
  static constexpr double limit = 0.05;  ///< s
  static constexpr int mostDivisor = 8;

  /// Width and height are divided by this; a power of two.
  int divisor() const { return divisor_; }

  /// A draft of that size took this long.
  void drew(double seconds);

  /// Pictures are of another kind from now on. The first takes longer, as it makes programs ready.
  void restart();

 private:
  double expected(std::size_t finer) const;

  int divisor_ = 4;
  bool first_ = true;
  std::array<double, 4> seconds_{};  ///< s, of the last draft of a size, from the finest on; 0: unknown
};

}  // namespace prelight::viewer
