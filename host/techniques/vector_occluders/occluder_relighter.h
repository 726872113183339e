#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "device/kernel.h"
#include "occluders/occluder_upload.h"
#include "prelight/transfer.h"

namespace prelight {

/// The vertices to light, [vertex].
struct OccluderReceivers {
  std::span<const glm::vec3> positions;  ///< scene coordinates: world minus `origin`
  std::span<const glm::vec3> normals;    ///< unit
  glm::dvec3 origin{0.0};
  std::span<const glm::vec4> gloss = {};  ///< reflectance along the normal, roughness; empty: all are diffuse

  std::vector<device::OccluderReceiverPoint> points() const;
};

/// Vector occluders on the device (host/techniques/vector_occluders/occluder_light_kernels.cl): computes the
/// light at every vertex through its records in time linear in records x lights. Records are uploaded once
/// and prepared once for all lights, or anew when shading parameters require it (waves, strength of caustics,
/// exponent). The device must outlive the relighter.
class OccluderRelighter {
 public:
  /// Throws UsageError when receivers do not match the transfer or it lacks a vector that shading needs.
  OccluderRelighter(DeviceContext& device, const OccluderTransfer& transfer,
                    const OccluderReceivers& receivers);

  std::size_t vertexCount() const { return vertices_; }
  std::size_t recordCount() const { return upload_.owners.size(); }

  /// Computes the light at every vertex, in `lit`, which has at least vertexCount() entries. Does not wait
  /// for the last launch.
  void relight(std::span<const device::OccluderLight> lights, const OccluderShading& shading,
               const OccluderEye& eye, Buffer<device::LitVertex>& lit);

  /// Writes the radiance that diffuse receivers send on, before their albedo, [vertex][3]. Does not wait.
  void takeDiffuse(const Buffer<device::LitVertex>& lit, Buffer<float>& radiance);

  /// Returns the light at every vertex; waits.
  std::vector<device::LitVertex> relight(std::span<const device::OccluderLight> lights,
                                         const OccluderShading& shading, const OccluderEye& eye = {});

 private:
  void prepare(const device::OccluderTerms& terms);

  DeviceContext& device_;
  OccluderUpload upload_;
  std::size_t vertices_ = 0;
  Buffer<glm::vec4> records_;
  Buffer<std::int32_t> owners_;
  Buffer<std::uint32_t> offsets_;
  Buffer<device::OccluderReceiverPoint> receivers_;
  Buffer<glm::vec4> waves_;
  Buffer<glm::vec4> prepared_;
  std::optional<device::OccluderTerms> preparedFor_;
  using Records = Buffer<glm::vec4>;
  using Receivers = Buffer<device::OccluderReceiverPoint>;
  Kernel<Records, Buffer<std::int32_t>, Receivers, Buffer<glm::vec4>, device::OccluderTerms, std::uint32_t,
         Records>
      prepareKernel_;
  Kernel<Buffer<std::uint32_t>, Records, Receivers, Buffer<device::OccluderLight>, Buffer<glm::vec4>,
         device::OccluderTerms, std::uint32_t, std::uint32_t, Buffer<device::LitVertex>>
      relightKernel_;
  Kernel<Buffer<device::LitVertex>, std::uint32_t, Buffer<float>> diffuseKernel_;
};

}  // namespace prelight
