#pragma once

#include <optional>
#include <vector>

#include "cast/fitted_column.h"
#include "device/kernel.h"
#include "fit/baseline.h"
#include "prelight/hemisphere_renderer.h"

namespace prelight {

/// Visibility of the hemisphere around a receiver: accessibility, mean open direction, and transfer in bands
/// of SH; see kernels/project/project_kernels.cl. It guides a cast: accessibility decides where
/// further receivers are placed, and its error is the cast's.
class HemisphereColumn final : public FittedColumn {
 public:
  static constexpr std::size_t firstBand = 4;  ///< of a row, after accessibility and direction

  /// `shOrder`: bands of SH; 0: none. `renderer` draws what receivers see and outlives the column; nullptr:
  /// kernels sum up what rays hit.
  explicit HemisphereColumn(int shOrder, HemisphereRenderer* renderer = nullptr);

  /// Accessibility of a block's receiver, in [0,1] but for rounding.
  float accessibility(const CastRows& rows, std::size_t receiver) const {
    return rows.of(*this).of<float>()[receiver * rowWidth()];
  }

  /// Row of a block's receiver: accessibility, then means over rays of what these see less the accessibility,
  /// of 3 of direction and the bands.
  const float* row(const CastRows& rows, std::size_t receiver) const {
    return &rows.of(*this).of<float>()[receiver * rowWidth()];
  }

  /// Closed-form values of unoccluded receivers, which the fit of a side is relative to.
  const Baseline& baselineOf(Side side) const { return (side == Side::Front ? front_ : back_).value(); }

  ColumnNeeds needs() const override { return {.rays = renderer_ == nullptr}; }
  std::uint32_t receiversAtOnce(DeviceKind kind, std::uint32_t usual) const override;
  void addParameters(const CastTask& task, DeviceLane lane, device::CastParameters& parameters) override;
  void start(const CastBlock& block) override;
  void finish(const CastBlock& block, ColumnRows& rows) override;
  std::unique_ptr<ColumnSums> makeSums(const SideShape& side) override;
  void addTo(VertexFit& fit, const SeenBlock& block, std::vector<double>& rows) const override;

 private:
  void allocate(const CastShape& shape) override;
  void askFor(std::span<const SurfaceSample> samples, std::size_t i, const Baseline& baseline) const;

  int shOrder_;
  HemisphereRenderer* renderer_;
  const FitMesh* mesh_ = nullptr;  ///< of the fits
  std::optional<Baseline> front_, back_;
  Buffer<float> shTable_;
  Kernel<Buffer<device::CastParameters>, Buffer<float>, Buffer<device::Ray>, Buffer<device::Hit>,
         Buffer<float>>
      project_;
};

}  // namespace prelight
