#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "device/kernel.h"
#include "prelight/compiled_scene.h"
#include "radiosity/form_factors.h"

namespace prelight {

/// The radiosity equation of a scene on the device. kernels/radiosity/solve_kernels.cl describes the layout.
class ExchangeSystem {
 public:
  /// The arguments are not kept.
  ExchangeSystem(DeviceContext& device, const CompiledScene& scene, const RadiosityElements& elements,
                 const FormFactors& factors);

  std::uint32_t size() const { return size_; }
  std::uint32_t perSide() const { return perSide_; }

  /// Returns the largest share of incident light that any element reflects or transmits in any channel. It
  /// bounds the spectrum.
  double greatestAlbedo() const { return greatestAlbedo_; }

  DeviceContext& device() const { return device_; }

  /// Returns the build options of the solver's kernels.
  const BuildOptions& options() const { return options_; }

  const Buffer<std::uint32_t>& rowStart() const { return rowStart_; }
  const Buffer<std::uint32_t>& columns() const { return columns_; }
  const Buffer<float>& values() const { return values_; }
  const Buffer<float>& scale() const { return scale_; }
  const Buffer<float>& areas() const { return areas_; }
  const Buffer<glm::vec4>& albedo() const { return albedo_; }
  const Buffer<glm::vec4>& transmission() const { return transmission_; }

 private:
  DeviceContext& device_;
  std::uint32_t size_;
  std::uint32_t perSide_;
  double greatestAlbedo_ = 0.0;
  Buffer<std::uint32_t> rowStart_;
  Buffer<std::uint32_t> columns_;
  Buffer<float> values_;
  Buffer<float> scale_;
  Buffer<float> areas_;
  Buffer<glm::vec4> albedo_;
  Buffer<glm::vec4> transmission_;
  BuildOptions options_;
};

/// Returns the transmission of light from the other side, [element]; all are 0 if nothing is translucent.
std::vector<glm::vec4> transmissionOfElements(const CompiledScene& scene, const RadiosityElements& elements,
                                              std::uint32_t count);

}  // namespace prelight
