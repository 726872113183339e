#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "cast/caster.h"
#include "cast/hemisphere_column.h"
#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"

namespace prelight {

/// A part of a triangle whose light is examined.
struct ProbedPart {
  std::uint32_t triangle = 0;           ///< of the compiled scene
  std::array<glm::dvec2, 3> corners{};  ///< weights of the triangle's vertices 1 and 2 at the part's corners
  int steps = 3;                        ///< receivers lie at the centroids of steps x steps smaller parts
};

/// An estimate of what linear interpolation over a part loses.
struct PartError {
  float error = 0.0f;  ///< without the noise of the estimate
  float bound = 0.0f;  ///< with noise; 0 where nothing changes

  bool operator==(const PartError&) const = default;
};

/// Estimates how much light linear interpolation over parts of triangles loses. Visibility in low bands of SH
/// stands for light. Every receiver casts two independent sets of directions, the same for all receivers of a
/// triangle: where nothing changes the estimate is exactly 0, however few rays there are, and elsewhere noise
/// does not count as detail.
class DetailProbe {
 public:
  static constexpr int order = 5;

  /// `rays`: per set of directions, a power of two, 8 to 256. `reaches`: m; visibility up to each distance is
  /// examined, too, which is what lamps at such distances need. The other arguments must outlive the object.
  DetailProbe(const CompiledScene& scene, Tracer& tracer, std::uint32_t rays,
              std::span<const double> reaches);

  /// Returns the error of each part: rms over the part, in all bands together, as a share of the transfer of
  /// an open surface; the largest of all distances. Receivers inside objects do not count. Progress is
  /// reported from `from` to `to`.
  std::vector<PartError> errorsOf(std::span<const ProbedPart> parts, Progress& progress, double from,
                                  double to);

  std::uint64_t rays() const { return rays_; }  ///< cast so far

 private:
  void addReceivers(const ProbedPart& part);
  /// Returns the errors for one distance, [part at hand]. `ends`: [part], of its receivers.
  std::vector<PartError> residualsOf(double reach, std::span<const std::size_t> ends,
                                     const Progress& progress);

  const CompiledScene& scene_;
  HemisphereColumn column_;
  Caster caster_;
  std::vector<double> reaches_;              ///< m; 0: all of the scene
  std::vector<device::Receiver> receivers_;  ///< of the parts at hand, [point][set of directions]
  std::vector<glm::dvec2> points_;           ///< [point], weights of its part's corners 1 and 2
  std::uint64_t rays_ = 0;
};

}  // namespace prelight
