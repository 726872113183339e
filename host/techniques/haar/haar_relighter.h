#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/haar.h"
#include "device/kernel.h"
#include "prelight/bake.h"

namespace prelight {

/// How sparse transfer is multiplied by a light with few coefficients.
enum class HaarForm : std::uint8_t {
  /// Transfer sorted by coefficient in blocks of vertices, of which only the light's columns are read.
  Columns,
  Rows,  ///< a vertex's whole row times a dense table of the light, which is mostly 0
};

/// Relights Haar transfer on the device by a light's selected coefficients.
class HaarRelighter {
 public:
  /// The device must outlive the relighter.
  HaarRelighter(DeviceContext& device, const HaarTransfer& transfer, HaarForm form = HaarForm::Columns);

  std::size_t vertexCount() const { return vertices_; }
  /// Returns the bytes of one relighting with the present light: those read of the transfer (indices, values,
  /// offsets) and those of radiance written.
  std::size_t bytesMoved() const { return bytesMoved_; }

  /// Sets the light. Throws UsageError for an index beyond the cube map.
  void setLight(std::span<const haar::LitWavelet> light);

  /// Computes radiance before albedo, [vertex][3]. Does not wait.
  void relight(Buffer<float>& radiance);

 private:
  void uploadRows(const HaarTransfer& transfer);
  void uploadColumns(const HaarTransfer& transfer);

  DeviceContext& device_;
  HaarForm form_;
  std::size_t texels_, channels_, vertices_, litCount_ = 0, bytesMoved_ = 0;
  std::vector<std::uint32_t> columnOffsets_;
  Buffer<std::uint32_t> offsets_;
  Buffer<std::uint32_t> indices_;
  Buffer<std::uint16_t> blockVertices_;
  Buffer<float> values_;
  Buffer<std::uint32_t> lit_;
  Buffer<float> light_;
  using Numbers = Buffer<std::uint32_t>;
  Kernel<Numbers, Numbers, Buffer<float>, Buffer<float>, std::uint32_t, Buffer<float>> rowsKernel_;
  Kernel<Numbers, Buffer<std::uint16_t>, Buffer<float>, Numbers, Buffer<float>, std::uint32_t, std::uint32_t,
         Buffer<float>>
      columnsKernel_;
};

}  // namespace prelight
