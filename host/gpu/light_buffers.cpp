#include "gpu/light_buffers.h"

#include <numbers>

namespace prelight {

LightBuffers::LightBuffers(DeviceContext& device, const LightTables& l)
    : tables_(device, std::span<const std::uint32_t>(l.tables)),
      emitters_(device, std::span<const std::uint32_t>(l.emitters)),
      emitterDensities_(device, std::span<const float>(l.emitterDensities)),
      punctual_(device, std::span<const device::PunctualLight>(l.punctual)),
      sky_(device, std::span<const glm::vec4>(l.sky)) {}

cl_uint LightBuffers::setArguments(cl::Kernel& kernel, cl_uint index) const {
  kernel.setArg(index, tables_.get());
  kernel.setArg(index + 1, emitters_.get());
  kernel.setArg(index + 2, emitterDensities_.get());
  kernel.setArg(index + 3, punctual_.get());
  kernel.setArg(index + 4, sky_.get());
  return index + argumentCount;
}

device::LightLayout lightLayout(const LightTables& l, double skyRotation) {
  device::LightLayout layout{};
  layout.groupCount = l.groupCount;
  layout.emitterGroup = l.emitterGroup;
  layout.emitterCount = static_cast<std::uint32_t>(l.emitters.size());
  layout.emitterTable = l.emitterTable;
  layout.rowTable = l.rowTable;
  layout.columnTable = l.columnTable;
  layout.skyWidth = l.skyWidth;
  layout.skyHeight = l.skyHeight;
  layout.skyTurn = static_cast<float>(skyRotation / (2.0 * std::numbers::pi));
  return layout;
}

}  // namespace prelight
