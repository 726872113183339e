#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "prelight/bake.h"
#include "prelight/device.h"
#include "techniques/haar/haar_model.h"
#include "viewer/programs/drawn_transfer.h"

namespace prelight {
class HaarRelighter;
}

namespace prelight::viewer {

/// Wavelet transfer: the light as a cube map, transformed; its coefficients by the sparse rows of every
/// vertex, once a light, on an OpenCL device or on the host; the radiance as a vertex attribute. Lights
/// outside the scene shine as seen from its centre.
class HaarLighting : public DrawnTransfer {
 public:
  /// The transfer and the device outlive it. `device` nullptr: on the host. `result`: Radiance, or Through
  /// for that of surfaces' other sides.
  HaarLighting(const HaarTransfer& transfer, const Device* device, Attribute result = Attribute::Radiance);
  ~HaarLighting() override;

  void light(const Illumination& light) override;
  void bind(const gl::Program& program) const override;
  void describe(const Illumination& light, Warnings& notes) const override;

  /// Coefficients of the light on the transfer's cube, [channel][i].
  std::vector<float> lightCoefficients(const Illumination& light) const;

  /// Radiance before albedo, [vertex], by the light's `terms` most important coefficients, or by all: 0.
  /// Their values are fitted under a model of the transfer, which is made when it is first needed.
  std::vector<glm::vec3> relight(const std::vector<float>& coefficients, std::size_t terms);

 private:
  haar::SparseLight kept(const std::vector<float>& coefficients, std::size_t terms);

  const HaarTransfer& transfer_;
  const Device* device_;
  std::optional<haar::TransferModel> model_;  ///< by which coefficients are chosen and fitted
  std::unique_ptr<HaarRelighter> relighter_;
  VertexStream accessibility_;
  VertexStream radiance_;
};

}  // namespace prelight::viewer
