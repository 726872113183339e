#pragma once

#include "device/buffer.h"
#include "gpu/light_tables.h"

namespace prelight {

/// Light tables on the device, as the members of a kernel's Lights (kernels/transport/light_table_funcs.cl).
class LightBuffers {
 public:
  static constexpr cl_uint argumentCount = 5;

  LightBuffers(DeviceContext& device, const LightTables& lights);

  /// Sets them as a kernel's arguments from `index` on; returns the index after them.
  cl_uint setArguments(cl::Kernel& kernel, cl_uint index) const;
  const Buffer<device::PunctualLight>& punctual() const { return punctual_; }

 private:
  Buffer<std::uint32_t> tables_, emitters_;
  Buffer<float> emitterDensities_;
  Buffer<device::PunctualLight> punctual_;
  Buffer<glm::vec4> sky_;
};

/// Where the parts of the tables lie. `skyRotation`: radians, counter-clockwise about +Y seen from above.
device::LightLayout lightLayout(const LightTables& lights, double skyRotation);

}  // namespace prelight
