#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/state_file.h"
#include "base/work_share.h"
#include "cast/told_marks.h"
#include "gpu/tracer.h"
#include "prelight/progress.h"
#include "radiosity/elements.h"
#include "shared/radiosity_types.h"

namespace prelight {

/// Hits of the rays of elements, as a sparse row of counts per element that was cast from.
struct ExchangeCounts {
  std::vector<std::uint32_t> elements;  ///< [row]
  std::vector<std::uint64_t> offsets;   ///< [row + 1], index into columns and counts
  std::vector<std::uint32_t> columns;   ///< elements that were hit, ascending within a row
  std::vector<std::uint16_t> counts;    ///< parallel to columns
  std::vector<std::uint32_t> rays;      ///< [row], rays from valid points
  std::vector<std::uint32_t> escaped;   ///< [row], rays among these that left the scene
  /// [row], mean albedo, and the share of the element that is valid: neither a hole nor inside an object.
  std::vector<glm::vec4> surface;
  std::vector<std::uint32_t> valid;  ///< [row], bit p: point p is valid, for the first 32 points
};

/// Casts cosine-distributed rays from points on elements, block by block: first from all fronts, then from
/// reflecting backs that rays have hit, and from those that these hit. The state can be saved after an
/// interruption and loaded elsewhere.
class FormFactorCast {
 public:
  /// All arguments must outlive the cast. `raysPerElement` is a power of two, 64 to 32768.
  FormFactorCast(const CompiledScene& scene, const RadiosityElements& elements, Tracer& tracer,
                 std::uint32_t raysPerElement, std::uint64_t seed);

  /// Casts all rays, continuing after load() or an interruption. Throws Interrupted.
  void run(Progress& progress);

  const ExchangeCounts& counts() const { return counts_; }
  std::uint32_t pointsPerElement() const { return pointsPerElement_; }
  const ElementPoints& points() const { return points_; }
  std::uint64_t rays() const { return std::uint64_t{raysPerElement_} * counts_.elements.size(); }

  void save(StateWriter& state) const;
  void load(StateReader& state);

 private:
  void checkLoaded(const StateReader& state) const;
  bool areRowsOf(const ExchangeCounts& rows, std::uint32_t count) const;
  bool areTriangles(const std::vector<std::uint32_t>& numbers) const;
  bool areRows(const ExchangeCounts& rows) const;
  bool isRow(const ExchangeCounts& rows, std::size_t row) const;
  void runRound(Progress& progress, WorkPart& part);
  bool startRound();
  void addBlock(SharedLoop& loop, std::uint32_t count);
  void append(const ExchangeCounts& rows);
  void castBlock(std::uint32_t count, ExchangeCounts& rows);
  void addRow(std::uint32_t element, const std::uint32_t* codes, const glm::vec4* judged,
              ExchangeCounts& rows);

  const RadiosityElements& elements_;
  Tracer& tracer_;
  DeviceContext& device_;
  std::uint32_t raysPerElement_;
  std::uint32_t raysPerPoint_;
  std::uint32_t pointsPerElement_;
  std::uint32_t blockSize_;  ///< in elements
  ElementPoints points_;
  ExchangeCounts counts_;
  std::vector<std::uint8_t> backCast_;  ///< [triangle], 1: cast in this or an earlier round
  std::vector<std::uint32_t> queue_;    ///< elements of this round
  std::uint64_t done_ = 0;              ///< finished elements of the queue
  std::uint32_t round_ = 0;             ///< 0: fronts
  std::vector<std::uint32_t> scratch_;
  Buffer<device::CastParameters> parameters_;
  Buffer<device::Receiver> receivers_;
  Buffer<device::ElementPoint> elementPoints_;
  Buffer<device::Ray> rays_;
  Buffer<device::Hit> hits_;
  Buffer<std::uint32_t> codes_;
  Buffer<glm::vec4> judged_;
  Buffer<glm::uvec2> pieces_;
  Buffer<float> normals_;
  Buffer<std::uint8_t> twoSided_;
  Buffer<std::uint8_t> reflecting_;
  Buffer<std::uint8_t> marks_;
  ToldMarks toldMarks_;

  using Rays = Buffer<device::Ray>;
  using Hits = Buffer<device::Hit>;
  using Bytes = Buffer<std::uint8_t>;
  Kernel<Buffer<device::CastParameters>, Buffer<device::Receiver>, Rays> generate_;
  Kernel<std::uint32_t, std::uint32_t, Rays, Hits, Buffer<glm::uvec2>, Buffer<float>, Bytes,
         Buffer<std::uint32_t>, Bytes>
      code_;
  Kernel<std::uint32_t, std::uint32_t, Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>,
         Buffer<device::ElementPoint>, Rays, Hits, Buffer<float>, Bytes, Buffer<glm::vec4>>
      judge_;
};

}  // namespace prelight
