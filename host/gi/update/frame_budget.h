#pragma once

#include <array>
#include <cstdint>
#include <functional>

namespace prelight {

/// Kinds of work of a frame of live light.
enum class FrameWork : std::uint8_t {
  Photons,    ///< photons sent again
  Estimates,  ///< density estimates of texels
  Rays,       ///< rays of final gathering
};

/// Divides the time of a frame among kinds of work by their measured costs.
class FrameBudget {
 public:
  using Clock = std::function<double()>;  ///< returns seconds since some moment

  static constexpr std::uint32_t unlimited = 0xffffffffu;

  /// `seconds` of work per frame; 0: unlimited. Without a clock each kind of work counts with its usual cost,
  /// so that the frames of every run do the same work.
  FrameBudget(double seconds, Clock clock);

  /// Begins a frame.
  void begin();

  /// Returns how many items of a kind fit into the rest of the frame, at least `leastItems`.
  std::uint32_t affordable(FrameWork kind) const;

  /// Registers items that have been done since the last call, or since begin().
  void spend(FrameWork kind, std::uint64_t items);

  /// Registers work of no kind that has been done since the last call.
  void spend();

  static constexpr std::uint32_t leastItems = 256;

 private:
  double elapsed();

  double seconds_;
  Clock clock_;
  double left_ = 0.0;            ///< s
  double last_ = 0.0;            ///< time of the last call
  std::array<double, 3> costs_;  ///< [kind], s per item
};

}  // namespace prelight
