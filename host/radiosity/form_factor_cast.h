#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/state_file.h"
#include "gpu/tracer.h"
#include "prelight/progress.h"
#include "radiosity/element_points.h"
#include "radiosity/elements.h"
#include "shared/radiosity_types.h"

namespace prelight {

/// Where the rays of elements went, a sparse row of counts for each that was cast from.
struct ExchangeCounts {
  std::vector<std::uint32_t> elements;  ///< [row]
  std::vector<std::uint64_t> offsets;   ///< [row + 1] into the two below
  std::vector<std::uint32_t> columns;   ///< elements that were met, ascending within a row
  std::vector<std::uint16_t> counts;    ///< parallel to columns
  std::vector<std::uint32_t> rays;      ///< [row], from places that count
  std::vector<std::uint32_t> escaped;   ///< [row], of those
  std::vector<glm::vec4> surface;  ///< [row] mean albedo, and the share of the element that counts: no hole,
                                   ///< not inside an object
  std::vector<std::uint32_t> valid;  ///< [row], bit p: point p counts, of the first 32
};

/// Casts cosine-distributed rays from points all over elements, block by block: from all fronts, then from
/// the backs that rays have met where they reflect, and from those that these meet. Can be saved after an
/// interruption and go on elsewhere.
class FormFactorCast {
 public:
  /// All outlive the cast. `raysPerElement` is a power of two, 64 to 32768.
  FormFactorCast(const CompiledScene& scene, const RadiosityElements& elements, Tracer& tracer,
                 std::uint32_t raysPerElement, std::uint64_t seed);

  /// Goes on after load(), and after it was interrupted. Throws Interrupted.
  void run(Progress& progress);

  const ExchangeCounts& counts() const { return counts_; }
  std::uint32_t pointsPerElement() const { return pointsPerElement_; }
  const ElementPoints& points() const { return points_; }
  std::uint64_t rays() const { return std::uint64_t{raysPerElement_} * counts_.elements.size(); }

  void save(StateWriter& state) const;
  void load(StateReader& state);

 private:
  void checkLoaded(const StateReader& state) const;
  void checkRow(std::size_t row, const StateReader& state) const;
  bool startRound();
  void castBlock(std::uint32_t count);
  void addRow(std::uint32_t element, const std::uint32_t* codes, const glm::vec4* judged);

  const RadiosityElements& elements_;
  Tracer& tracer_;
  DeviceContext& device_;
  std::uint32_t raysPerElement_;
  std::uint32_t raysPerPoint_;
  std::uint32_t pointsPerElement_;
  std::uint32_t blockSize_;  ///< elements
  ElementPoints points_;
  ExchangeCounts counts_;
  std::vector<std::uint8_t> backCast_;  ///< [triangle], 1: in this round or an earlier one
  std::vector<std::uint32_t> queue_;    ///< elements of this round
  std::uint64_t done_ = 0;              ///< of the queue
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
