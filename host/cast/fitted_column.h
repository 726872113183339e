#pragma once

#include <memory>
#include <vector>

#include "cast/column.h"
#include "fit/vertex_fit.h"

namespace prelight {

class SideSums;

/// Returns a fit of `columns` values to the vertices of a side, without samples.
VertexFit emptyFit(const SideShape& side, std::size_t columns);

/// A column of floats whose rows the vertices are fitted to by least squares.
class FittedColumn : public Column {
 public:
  /// Kernels write `rowWidth` floats per receiver, 0: none; the fit is of `fitWidth` columns.
  FittedColumn(std::size_t rowWidth, std::size_t fitWidth) : rowWidth_(rowWidth), fitWidth_(fitWidth) {}

  /// Floats per receiver, and columns of the fit.
  std::size_t rowWidth() const { return rowWidth_; }
  std::size_t fitWidth() const { return fitWidth_; }

  /// Returns the fit of a side whose receivers have rows.
  const VertexFit& fitOn(const SideSums& side) const;

  void finish(const CastBlock& block, ColumnRows& rows) override;
  void loadBlock(StateReader& state, const CastTask& task, std::uint32_t receivers,
                 const ColumnRows& rows) override;
  std::unique_ptr<ColumnSums> makeSums(const SideShape& side) override;

  /// Adds a block to the fit: its rows as they are. A column whose fit is relative to a closed form overrides
  /// this. `rows` is scratch memory.
  virtual void addTo(VertexFit& fit, const SeenBlock& block, std::vector<double>& rows) const;

 protected:
  void allocate(const CastShape& shape) override;
  Buffer<float>& valuesOf(const CastBlock& block) { return values_.of(block); }

 private:
  std::size_t rowWidth_;
  std::size_t fitWidth_;
  DeviceRows<float> values_;
};

/// Sums of a FittedColumn: the fit of one side.
class FittedSums final : public ColumnSums {
 public:
  /// The column outlives it.
  FittedSums(const FittedColumn& column, VertexFit fit) : column_(column), fit_(std::move(fit)) {}

  VertexFit& fit() { return fit_; }
  const VertexFit& fit() const { return fit_; }

  void add(const SeenBlock& block) override { column_.addTo(fit_, block, rows_); }
  void extendTo(const std::vector<std::uint8_t>& slots) override { fit_.extendTo(slots); }
  void leaveOut(const std::shared_ptr<const std::vector<float>>& unseen) override { fit_.leaveOut(unseen); }
  void park() override { fit_.park(); }
  void fetch() override { fit_.fetch(); }
  void save(StateWriter& state) const override { fit_.save(state); }
  void load(StateReader& state, const SeenCounts& /*counts*/) override { fit_.load(state); }

 private:
  const FittedColumn& column_;
  VertexFit fit_;
  std::vector<double> rows_;  ///< of the block at hand, [sample][column of the fit]
};

}  // namespace prelight
