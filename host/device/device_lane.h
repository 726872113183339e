#pragma once

#include <cstddef>

namespace prelight {

/// One of a device's in-order command queues. Commands of a lane run in the order in which they were given;
/// commands of different lanes run concurrently and fill each other's idle times.
struct DeviceLane {
  static constexpr std::size_t count = 2;

  std::size_t number = 0;  ///< less than count
};

}  // namespace prelight
