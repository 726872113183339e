#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cast/caster.h"
#include "fit/baseline.h"
#include "fit/error_estimate.h"
#include "fit/vertex_fit.h"
#include "projectors/occluder_means.h"
#include "projectors/projections.h"
#include "projectors/schedule.h"
#include "projectors/texel_rows.h"
#include "receivers/surface_sampler.h"

namespace prelight {

/// Receivers that were cast together, and what they saw.
struct CastBlock {
  std::vector<SurfaceSample> samples;
  std::vector<device::Receiver> receivers;  ///< parallel to samples
  CastValues values;                        ///< of the receivers
  std::uint32_t group = 0;                  ///< of the error estimate, below errorGroups
  bool occluders = false;                   ///< whether the values tell occluders apart
};

/// In [0,1], but for rounding.
bool isShare(float value);

/// What the vertices of a side are fitted to.
struct FittedSide {
  std::vector<float> values;  ///< relative to the baseline, [slot][column]
  ErrorEstimate error;        ///< of AO
};

/// What the receivers of one side of the surface saw, summed up for the fits of the vertices.
class SideSums {
 public:
  /// `projections` and `baseline` are those of this side. The samples of a triangle weigh its entry of
  /// `areas` where the schedule has an error to reach: receivers crowd where it is not met yet.
  SideSums(const CompiledScene& scene, const FitMesh& mesh, const Schedule& schedule,
           const Projections& projections, Baseline baseline, const std::vector<double>& areas);

  /// Adds a block of receivers; the result depends on the order of blocks.
  /// Receivers inside objects lose their weight in the block.
  void add(CastBlock& block);

  /// Fitted values are wanted at the corners of these triangles alone, [triangle]; of all unless it is
  /// called.
  void limitTo(std::span<const std::uint8_t> triangles);

  /// Ends the sums of a round: smooths where what bends is noise. Until the next round begins.
  void stiffen(const Progress& progress);
  void soften() { fit_.stiffen({}); }

  const VertexFit& fit() const { return fit_; }
  const VertexFit& bentFit() const { return bentFit_.value(); }
  const VertexFit& lightFit() const { return lightFit_.value(); }
  const VertexFit& shellFit() const { return shellFit_.value(); }
  const VertexFit& sectorFit() const { return sectorFit_.value(); }
  const VertexFit& specularFit() const { return specularFit_.value(); }
  const OccluderMeans& occluders() const { return occluders_.value(); }
  const TexelRows& texelRows() const { return texelRows_; }
  const Baseline& baseline() const { return baseline_; }
  const SampleRecords& records() const { return records_; }

  /// A fit of the first `count` records alone, of AO: for right-hand sides of other columns.
  VertexFit fitOf(std::size_t count) const;

  /// Sums go to a file until they are needed: the fits are solved from there, and unpark() readies them for
  /// further blocks.
  void park();
  void unpark();

  /// The fit's solution, and the standard error of its AO.
  FittedSide solve(const Progress& progress) const;
  ErrorEstimate estimateError(const Progress& progress) const;

  /// Whether all rays around a triangle met the same, and enough of them were cast to believe it. Triangles
  /// around which all were blocked count where `closedToo`.
  bool isPlain(std::size_t triangle, bool closedToo) const;

  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// Records beyond this number are not kept.
  static constexpr std::size_t mostRecords = std::size_t{1} << 24;  // 400 MB

 private:
  VertexFit plainFit(std::size_t columns) const;
  ErrorEstimate errorOf(const NormalEquations& equations, std::span<const float> values, std::size_t columns,
                        int steps, const Progress& progress) const;
  void addFurther(std::optional<VertexFit>& fit, const CastBlock& block, const std::vector<float>& values);
  /// Calls use(fit) for the fits besides the first that there are.
  template <typename Use>
  void forFurtherFits(const Use& use) {
    for (std::optional<VertexFit>* fit : {&bentFit_, &lightFit_, &shellFit_, &specularFit_, &sectorFit_})
      if (*fit) use(**fit);
  }
  void askFor(std::span<const SurfaceSample> samples, std::size_t i) const;
  void addReceiver(const CastBlock& block, std::size_t i);
  void addBentNormal(const SurfaceSample& sample, const glm::dvec3& meanOpen);
  void addShells(const CastBlock& block);
  void addSectors(const CastBlock& block);
  void markSlots(const SurfaceSample& sample, double open);
  void check(const StateReader& state) const;
  void weighUnseen(CastBlock& block);
  void shareUnseen();

  const CompiledScene& scene_;
  const FitMesh& mesh_;
  const Schedule& schedule_;
  const Projections& projections_;
  const std::vector<double>& areas_;
  Baseline baseline_;
  VertexFit fit_;
  std::optional<VertexFit> bentFit_;
  std::optional<VertexFit> lightFit_;
  std::optional<VertexFit> shellFit_;
  std::optional<VertexFit> specularFit_;
  std::optional<VertexFit> sectorFit_;
  std::optional<OccluderMeans> occluders_;
  SampleRecords records_;
  TexelRows texelRows_;
  std::shared_ptr<std::vector<float>> unseen_;  ///< [triangle], weight that receivers inside objects lost
  std::vector<std::uint8_t> seen_;       ///< [slot], what rays around it met: bit 0 the open, bit 1 surface
  std::vector<std::uint32_t> slotRays_;  ///< [slot], rays of the triangles around it
  std::uint64_t receivers_ = 0;
  std::vector<double> residual_;                        ///< of the receiver at hand
  std::vector<double> rows_, furtherRows_, shellRows_;  ///< of the block at hand, [receiver][column]
  std::vector<SurfaceSample> bentSamples_;              ///< of the block at hand, those with a direction
  std::vector<double> bentRows_;                        ///< [bent sample][3]
};

}  // namespace prelight
