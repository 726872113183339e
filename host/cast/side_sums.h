#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cast/column.h"
#include "cast/hemisphere_column.h"
#include "cast/schedule.h"
#include "fit/error_estimate.h"
#include "fit/sample_records.h"
#include "fit/vertex_fit.h"
#include "prelight/progress.h"

namespace prelight {

/// In [0,1], but for rounding.
bool isShare(float value);

/// Solution of the hemisphere's fit on one side.
struct FittedSide {
  std::vector<float> values;  ///< relative to the baseline, [slot][column]
  ErrorEstimate error;        ///< of accessibility
};

/// How sums use memory.
struct SumMemory {
  std::uint64_t recordBytes = 0;  ///< bytes of records of both sides that are kept in memory
  bool parks = false;             ///< sums that wait lie in a file
};

/// Sums of all columns over the receivers of one side of the surface, and the records of these receivers, by
/// which the cast decides where further ones are needed.
class SideSums {
 public:
  /// `columns` are the caster's, `guide` is one of them; they and what `side` refers to outlive the sums.
  SideSums(const SideShape& side, const Schedule& schedule, HemisphereColumn& guide,
           const std::vector<Column*>& columns, const SumMemory& memory);

  /// Adds a block of receivers; the result depends on the order of blocks.
  /// Receivers inside objects lose their weight in the block.
  void add(SeenBlock& block);

  /// Fitted values are wanted at the corners of these triangles alone, [triangle]; of all unless it is
  /// called.
  void limitTo(std::span<const std::uint8_t> triangles);

  /// Ends the sums of a round: smooths where what bends is noise. Until the next round begins.
  void stiffen(const Progress& progress);
  void soften() { guideSums().fit().stiffen({}); }

  /// Returns the sums of a column that has rows on this side.
  const ColumnSums& of(const Column& column) const { return *sums_[column.index()]; }

  /// The fit of the hemisphere.
  const VertexFit& fit() const { return guide_.fitOn(*this); }
  const SampleRecords& records() const { return records_; }

  /// A fit of the first `count` records alone, of accessibility: for right-hand sides of other columns.
  VertexFit fitOf(std::size_t count) const;

  /// Sums go to a file until they are needed: the fits are solved from there, and unpark() readies them for
  /// further blocks.
  void park();
  void unpark();

  /// The fit's solution, and the standard error of its accessibility.
  FittedSide solve(const Progress& progress) const;
  ErrorEstimate estimateError(const Progress& progress) const;

  /// Whether all rays around a triangle met the same, and enough of them were cast to believe it. Triangles
  /// around which all were blocked do not count where columns need those rays.
  bool isPlain(std::size_t triangle) const;

  /// `stored`: receivers whose rows stay on the device.
  void save(StateWriter& state) const;
  void load(StateReader& state, std::uint32_t stored);

 private:
  FittedSums& guideSums() const { return static_cast<FittedSums&>(*sums_[guide_.index()]); }
  ErrorEstimate errorOf(const NormalEquations& equations, std::span<const float> values, std::size_t columns,
                        int steps, const Progress& progress) const;
  /// Calls use(sums) for the columns that have some.
  template <typename Use>
  void forAll(const Use& use) const {
    for (const std::unique_ptr<ColumnSums>& sums : sums_)
      if (sums) use(*sums);
  }
  void weighUnseen(SeenBlock& block);
  void shareUnseen();
  void record(const SeenBlock& block);
  void askFor(std::span<const SurfaceSample> samples, std::size_t i) const;
  void markSlots(const SurfaceSample& sample, double open);
  void check(const StateReader& state) const;

  SideShape side_;
  const Schedule& schedule_;
  const std::vector<double>& areas_;
  HemisphereColumn& guide_;
  SumMemory memory_;
  bool blockedRays_ = false;                       ///< some column needs them, see ColumnNeeds
  std::vector<std::unique_ptr<ColumnSums>> sums_;  ///< [column]; nullptr: it has none
  SampleRecords records_;
  std::shared_ptr<std::vector<float>> unseen_;  ///< [triangle], weight that receivers inside objects lost
  std::vector<std::uint8_t> seen_;       ///< [slot], what rays around it met: bit 0 the open, bit 1 surface
  std::vector<std::uint32_t> slotRays_;  ///< [slot], rays of the triangles around it
  std::uint64_t receivers_ = 0;
};

}  // namespace prelight
