#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "receivers/fit_mesh.h"
#include "shared/cast_types.h"

namespace prelight {

/// Position and weight of a receiver.
struct SurfaceSample {
  std::uint32_t triangle = 0;
  float b1 = 0.0f;  ///< barycentric weight of vertex 1
  float b2 = 0.0f;
  float weight = 0.0f;  ///< area that a receiver of its triangle and pass represents, relative to the mean
};

/// Returns the barycentric weights of the triangle's corners.
inline std::array<double, 3> cornerWeights(const SurfaceSample& sample) {
  return {1.0 - double(sample.b1) - double(sample.b2), sample.b1, sample.b2};
}

/// Side of a surface.
enum class Side : std::uint8_t { Front, Back };

/// Returns the unit geometric normal of a triangle's front.
glm::dvec3 orientedNormal(const CompiledScene& scene, std::uint32_t triangle);

/// Returns the weights of vertices 1 and 2 of a point, moved towards the triangle's centroid where rounding
/// could put the point beyond an edge, from where it could see past a wall that meets the triangle there.
glm::dvec2 keptOffEdges(const CompiledScene& scene, std::uint32_t triangle, const glm::dvec2& weights);

/// Returns a receiver at a sample, lifted off its triangle by the rounding error, with a normal on the given
/// side. The caller must set its sequence (seed, firstSample).
device::Receiver receiverAt(const CompiledScene& scene, const SurfaceSample& sample, Side side);

/// Places receivers on the surface, pass by pass. Half of the receivers are distributed to triangles by area
/// and half to all triangles equally, so that large triangles are covered and small ones are not starved.
/// Positions within a triangle are low-discrepancy over all passes. Triangles, and places within one, follow
/// Morton curves, so that consecutive receivers see similar parts of the scene. A pass depends only on the
/// passes before it, the seed and the sets of active and of thinned triangles.
class SurfaceSampler {
 public:
  SurfaceSampler(const CompiledScene& scene, std::uint64_t seed, Side side, std::uint32_t replicates = 1);

  /// Makes a sampler for another side of the surface with the same shares of triangles.
  SurfaceSampler(const SurfaceSampler& other, std::uint64_t seed, Side side);

  Side side() const { return side_; }

  /// Returns which triangles later passes place receivers on; initially all.
  std::vector<std::uint8_t>& active() { return active_; }
  const std::vector<std::uint8_t>& active() const { return active_; }

  /// [triangle], 1: later passes place 1/thinning of the receivers there, with weights increased accordingly.
  /// The expectation of a pass's weighted samples does not depend on the choice of triangles.
  std::vector<std::uint8_t>& thinned() { return thinned_; }
  const std::vector<std::uint8_t>& thinned() const { return thinned_; }
  static constexpr double thinning = 4.0;

  /// Progress within the sequences.
  struct Position {
    std::vector<std::uint32_t> taken;  ///< [triangle][replicate], receivers placed so far
    std::uint32_t passes = 0;
  };
  const Position& position() const { return position_; }
  void restore(const Position& position) { position_ = position; }

  /// Raises the shares of small connected components of the surface (connected through slots), so that about
  /// `least` of `receivers` fall on each: a component without receivers would have no values.
  void coverComponents(const FitMesh& mesh, double receivers, double least);

  /// Frees data that only passes need. No pass may follow on any side.
  void endPasses() {
    surface_->shares = std::vector<double>();
    surface_->order = std::vector<std::uint32_t>();
  }

  /// Returns the area of each triangle, [triangle], m2.
  const std::vector<double>& areas() const { return surface_->areas; }

  using Sink = std::function<void(const SurfaceSample&, const device::Receiver&)>;

  /// Yields about `receivers` receivers, fewer by the share of inactive and thinned triangles. Each casts
  /// `raysPerReceiver` rays of its triangle's sequence.
  void pass(double receivers, std::uint32_t raysPerReceiver, const Sink& sink);

 private:
  /// Data common to all sides.
  struct Surface {
    std::vector<double> areas;  ///< [triangle], m2
    double totalArea = 0.0;
    std::vector<double> shares;        ///< [triangle], share of a pass's receivers
    std::vector<std::uint32_t> order;  ///< triangles along a Morton curve of their centroids
  };

  /// A place on a triangle in a pass.
  struct Place {
    std::uint32_t index = 0;  ///< index in the triangle's sequence
    std::uint64_t code = 0;   ///< Morton code of the point in the sequence's square
    glm::dvec2 point{};
  };

  /// A triangle with receivers in a pass.
  struct Picked {
    std::uint32_t triangle = 0;
    std::uint64_t receivers = 0;
  };

  /// Number of triangles from which some are picked before receivers are placed on these, so that the data
  /// that they need, which is scattered in memory, has been prefetched.
  static constexpr std::size_t pickedAtOnce = 256;

  static std::shared_ptr<Surface> surfaceOf(const CompiledScene& scene);
  double shareOf(std::size_t triangle) const {
    return surface_->shares[triangle] / (thinned_[triangle] ? thinning : 1.0);
  }
  /// Picks among the order's triangles from `first` on; `sum` is the running sum of the pass.
  void pick(std::size_t first, double receivers, double& sum);
  void askFor(std::uint32_t triangle) const;
  void placeOn(const Picked& picked, std::uint32_t replicate, std::uint32_t raysPerReceiver,
               const Sink& sink);
  void choosePlaces(std::uint32_t sequence, std::uint64_t count);
  void setSequence(std::uint32_t sequence, std::uint32_t index, std::uint32_t raysPerReceiver,
                   device::Receiver& receiver) const;

  const CompiledScene& scene_;
  std::uint32_t seed_;
  Side side_;
  std::shared_ptr<Surface> surface_;
  std::vector<std::uint8_t> active_;
  std::uint32_t replicates_;
  std::vector<std::uint8_t> thinned_;
  Position position_;
  std::vector<Picked> picked_;  ///< from the current part of the order
  std::vector<Place> places_;   ///< on the current triangle
};

/// Returns the triangle whose front or back contains a texel's place.
std::uint32_t triangleOf(const CompiledScene& scene, const LightMapTexel& texel);

/// Returns a receiver at a texel's place, on the side of its face. The caller must set its sequence.
device::Receiver receiverAt(const CompiledScene& scene, const LightMapTexel& texel);

}  // namespace prelight
