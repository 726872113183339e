#pragma once

#include <cstddef>

namespace prelight {

/// Which of a device's in-order queues a command is for. Commands of a lane run in the order in which they
/// were given, those of two lanes side by side: what one of them leaves idle, the other fills.
struct DeviceLane {
  static constexpr std::size_t count = 2;

  std::size_t number = 0;  ///< below count
};

}  // namespace prelight
