#pragma once

#include <optional>
#include <vector>

#include "prelight/relighter.h"
#include "relight/device/light_projector.h"

namespace prelight {

/// Throws UsageError unless the numbers of the light are finite, directions have a length, angles are in
/// range, and the rotation is orthonormal.
void checkRelighterLight(const RelighterLight& light);

/// Returns whether a distant light has a size, at least 1e-6 radians.
bool hasSize(const DistantLight& light);

/// Returns the radiance of a distant light with a size: its irradiance over the projected solid angle.
glm::dvec3 radianceOf(const DistantLight& light);

/// Brings the light of a relighter into SH. Skies are projected on the device, by tables for the last sky's
/// size.
class HarmonicLight {
 public:
  /// The device must outlive the object. `order` is 1 to 32.
  HarmonicLight(DeviceContext& device, int order) : device_(device), order_(order) {}

  int order() const { return order_; }

  /// Returns the coefficients of sky, lights and further radiance, [channel][i], 3 x order^2. Throws
  /// InputError for a sky that is not one, and UsageError for coefficients whose number is not 3 x a square.
  std::vector<double> coefficientsOf(const RelighterLight& light);

 private:
  std::vector<float> skyOf(const Environment& sky, const glm::dmat3& rotation);

  DeviceContext& device_;
  int order_;
  int width_ = 0, height_ = 0;  ///< size of skies that the projector takes
  std::optional<LightProjector> projector_;
};

}  // namespace prelight
