#pragma once

#include <glm/glm.hpp>
#include <span>

#include "device/buffer.h"
#include "transfer/light_map_layout.h"

namespace prelight {

/// Irradiance by texel on the device, for kernels/gather/irradiance_map_funcs.cl.
class IrradianceMap {
 public:
  IrradianceMap(DeviceContext& device, const LightMapLayout& layout);

  /// [y][x] W/m2.
  void set(std::span<const glm::vec3> irradiance);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Sets corners and texels as two kernel arguments from `index` on; returns the index after them.
  cl_uint setArguments(cl::Kernel& kernel, cl_uint index) const;

 private:
  int width_;
  int height_;
  Buffer<glm::vec2> corners_;
  Buffer<glm::vec4> texels_;
};

}  // namespace prelight
