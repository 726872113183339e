#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "prelight/relighter.h"
#include "relight/device/dense_relighter.h"
#include "relight/device/relighting.h"

namespace prelight {

/// Distant lights at receivers whose normals are known. Where nothing blocks a light, a receiver gets exactly
/// what it gives (one that the horizon cuts, what its centre would give); the transfer says which share of it
/// arrives, and what bounces add. The lights are summed on the host, once.
class OpenLights {
 public:
  /// `normals` are unit, one per receiver. `isVisibility`: the transfer has no bounces, so that shadows,
  /// which truncation blurs, can be sharpened. The device must outlive the object.
  OpenLights(DeviceContext& device, std::vector<glm::vec3> normals, int order, bool isVisibility);

  /// Forgets all lights.
  void clear();

  /// Adds a light, turned, of which the transfer leaves `through`, [receiver][3], at an irradiance of 1
  /// (basis/lights/lamp_through_transfer.h).
  void add(const DistantLight& light, std::span<const float> through);

  /// Brings the sum to the device.
  void upload();

  /// Adds it to radiance before albedo, [receiver][3].
  void addTo(Buffer<float>& radiance);

  /// Returns the bytes that addTo() reads and writes.
  std::size_t bytesMoved() const { return lit_ ? lit_->bytesMoved() + colors_.size() * sizeof(float) : 0; }

 private:
  DeviceContext& device_;
  std::vector<glm::vec3> normals_;
  int order_;
  bool isVisibility_;
  std::vector<float> colors_;            ///< [receiver][3], radiance before albedo; empty without lights
  std::unique_ptr<DenseRelighter> lit_;  ///< adds the colours; nullptr without lights
};

/// Returns these lights for transfer of vertices, nullptr without vertices or a scene. Throws InputError for
/// a scene with another number of vertices.
std::unique_ptr<OpenLights> openLightsAt(const RelitSource& source, std::size_t vertices, int order,
                                         int channels);

}  // namespace prelight
