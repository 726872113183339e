#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "device/buffer.h"
#include "prelight/light_map.h"
#include "shared/gather_types.h"

namespace prelight {

/// Irradiance per texel on the device, for kernels/gather/irradiance_map_funcs.cl.
class IrradianceMap {
 public:
  /// `patches`, [texel of the layout], are those of SurfacePatches::at() on which caustics are looked up;
  /// empty: there are no caustics, or they are sorted by region.
  IrradianceMap(DeviceContext& device, const LightMapLayout& layout,
                std::span<const std::uint32_t> patches = {});

  /// Uploads irradiance, [y][x], W/m2.
  void set(std::span<const glm::vec3> irradiance);

  const device::IrradianceMapLayout& layout() const { return layout_; }
  const Buffer<device::IrradianceLine>& lines() const { return lines_; }

 private:
  device::IrradianceMapLayout layout_{};
  std::vector<float> inside_;  ///< [y][x], 1 where a texel lies inside an object; empty: nowhere
  Buffer<device::IrradianceLine> lines_;
};

}  // namespace prelight
