#pragma once

#include <memory>
#include <vector>

#include "prelight/bake.h"
#include "prelight/device.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/drawn_transfer.h"
#include "viewer/techniques/glossy/specular_lobes.h"

namespace prelight {
class GlossyRelighter;
}
#include "viewer/techniques/glossy/matrix_visibility.h"

namespace prelight::viewer {

/// Share of an even sky's light that arrives at each vertex, mean of the channels, 0..1.
std::vector<float> glossyAccessibility(const GlossyTransfer& transfer);

/// Glossy transfer: matrices times light once a light, on an OpenCL device or on the host; the fragment
/// shader weighs what arrives, interpolated between vertices, with the material's lobe
/// (techniques/glossy/glossy.glsl). The matrices hold the diffuse transfer as well: T_j = sqrt(4 pi) M_0j.
/// Lamps are evaluated for every vertex, on the host: their share that arrives (MatrixVisibility) dims their
/// diffuse light and their highlights, which have the exact lobe. Measured lobes have lamps by the matrices.
class GlossyLighting : public DrawnTransfer {
 public:
  /// Transfer, scene and device outlive it. `device` nullptr: on the host.
  GlossyLighting(const GlossyTransfer& transfer, const CompiledScene& scene, Lobe lobe, const Device* device);
  ~GlossyLighting() override;

  void light(const Illumination& light) override;
  bool verticesMoved() override { return lampsShine_; }
  void bind(const gl::Program& program) const override;
  void describe(const Illumination&, Warnings&) const override {}

 private:
  /// The light of a view at vertices.
  struct LitVertices {
    std::vector<float> arriving;     ///< [vertex][3][i]
    std::vector<glm::vec3> diffuse;  ///< [vertex], exit radiance over albedo
    std::vector<glm::vec3> bounced;  ///< [vertex], what of it bounces send of lamps
    std::vector<float> highlights;   ///< [vertex], share of the lamps' light that arrives
  };

  std::vector<float> arriving(const std::vector<double>& light);
  void boundRinging(const std::vector<double>& smoothed, std::vector<glm::vec3>& diffuse) const;
  void addLamps(const std::vector<ShadedLight>& lamps, LitVertices& lit) const;

  const GlossyTransfer& transfer_;
  const CompiledScene& scene_;
  const Device* device_;
  Lobe lobe_;
  std::unique_ptr<GlossyRelighter> relighter_;
  gl::BufferTexture lobes_;
  gl::BufferTexture measuredLobes_;
  gl::BufferTexture arriving_;  ///< [vertex][i] RGB
  VertexStream accessibility_;
  VertexStream radiance_;  ///< diffuse
  VertexStream highlights_;
  MatrixVisibility visibility_;
  bool lampsInMatrices_;     ///< lobes have them by what arrives
  bool lampsShine_ = false;  ///< in the last light
};

}  // namespace prelight::viewer
