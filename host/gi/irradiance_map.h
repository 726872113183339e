#pragma once

#include <glm/glm.hpp>
#include <span>

#include "device/buffer.h"
#include "prelight/light_map.h"
#include "shared/gather_types.h"

namespace prelight {

/// Irradiance by texel on the device, for kernels/gather/irradiance_map_funcs.cl.
class IrradianceMap {
 public:
  IrradianceMap(DeviceContext& device, const LightMapLayout& layout);

  /// [y][x] W/m2.
  void set(std::span<const glm::vec3> irradiance);

  const device::IrradianceMapLayout& layout() const { return layout_; }
  const Buffer<device::IrradianceLine>& lines() const { return lines_; }

 private:
  device::IrradianceMapLayout layout_{};
  Buffer<device::IrradianceLine> lines_;
};

}  // namespace prelight
