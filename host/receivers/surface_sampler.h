#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "prelight/compiled_scene.h"
#include "receivers/fit_mesh.h"
#include "shared/cast_types.h"

namespace prelight {

/// Where a receiver sits and what it stands for.
struct SurfaceSample {
  std::uint32_t triangle = 0;
  float b1 = 0.0f;  ///< barycentric weight of vertex 1
  float b2 = 0.0f;
  float weight = 0.0f;  ///< surface that a receiver of its triangle and pass stands for, relative to the mean
};

/// Barycentric weights of a sample's triangle's corners.
inline std::array<double, 3> cornerWeights(const SurfaceSample& sample) {
  return {1.0 - double(sample.b1) - double(sample.b2), sample.b1, sample.b2};
}

enum class Side : std::uint8_t { Front, Back };

/// Unit geometric normal of a triangle's front.
glm::dvec3 orientedNormal(const CompiledScene& scene, std::uint32_t triangle);

/// Weights of vertices 1 and 2 of a point of a triangle, moved towards its centroid where rounding could put
/// the point beyond an edge, to see past the wall that meets it there.
glm::dvec2 keptOffEdges(const CompiledScene& scene, std::uint32_t triangle, const glm::dvec2& weights);

/// A receiver at a sample, lifted off its triangle by the rounding error, whose normal is on the side that it
/// is asked for. Its sequence (seed, firstSample) is
/// the caller's to set.
device::Receiver receiverAt(const CompiledScene& scene, const SurfaceSample& sample, Side side);

/// Places receivers on the surface, pass by pass. Half of them go to triangles by area and half to every
/// triangle alike, so that large triangles are covered and small ones are not starved. Positions within a
/// triangle are low-discrepancy over all passes. Triangles, and places within one, follow Morton curves, so
/// that consecutive receivers see much the same. What a pass yields depends on the passes before it, the seed
/// and the sets of active and of thinned triangles alone.
class SurfaceSampler {
 public:
  SurfaceSampler(const CompiledScene& scene, std::uint64_t seed, Side side, std::uint32_t replicates = 1);

  /// For another side of the surface, whose triangles have the same shares.
  SurfaceSampler(const SurfaceSampler& other, std::uint64_t seed, Side side);

  Side side() const { return side_; }

  /// Triangles that further passes place receivers on; all at first.
  std::vector<std::uint8_t>& active() { return active_; }
  const std::vector<std::uint8_t>& active() const { return active_; }

  /// [triangle], 1: further passes place a `thinning`th of the receivers there, each of which stands for that
  /// much more. Whatever decides it, the expectation of a pass's weighted samples stays the same.
  std::vector<std::uint8_t>& thinned() { return thinned_; }
  const std::vector<std::uint8_t>& thinned() const { return thinned_; }
  static constexpr double thinning = 4.0;

  /// How far the sequences have been used.
  struct Position {
    std::vector<std::uint32_t> taken;  ///< [triangle][replicate], receivers so far
    std::uint32_t passes = 0;
  };
  const Position& position() const { return position_; }
  void restore(const Position& position) { position_ = position; }

  /// Raises the share of small stretches of surface, so that about `least` of `receivers` fall on each that
  /// hangs together through slots: nothing else would say what one without a receiver looks like.
  void coverComponents(const FitMesh& mesh, double receivers, double least);

  /// No pass follows on any side: frees what only passes read.
  void endPasses() {
    surface_->shares = std::vector<double>();
    surface_->order = std::vector<std::uint32_t>();
  }

  /// [triangle], m2.
  const std::vector<double>& areas() const { return surface_->areas; }

  using Sink = std::function<void(const SurfaceSample&, const device::Receiver&)>;

  /// Yields about `receivers` receivers, fewer by the share of inactive and of thinned triangles.
  /// Each looks along `raysPerReceiver` directions of its triangle's sequence.
  void pass(double receivers, std::uint32_t raysPerReceiver, const Sink& sink);

 private:
  /// What all sides have in common.
  struct Surface {
    std::vector<double> areas;  ///< [triangle], m2
    double totalArea = 0.0;
    std::vector<double> shares;        ///< [triangle], of a pass's receivers
    std::vector<std::uint32_t> order;  ///< triangles along a Morton curve of their centroids
  };

  /// A place of a triangle that a pass takes.
  struct Place {
    std::uint32_t index = 0;  ///< in the triangle's sequence
    std::uint64_t code = 0;   ///< along the Morton curve of the sequence's square
    glm::dvec2 point{};
  };

  /// A triangle that a pass places receivers on.
  struct Picked {
    std::uint32_t triangle = 0;
    std::uint64_t receivers = 0;
  };

  /// Triangles of the order that are looked through before receivers are placed on those picked among them:
  /// what these read lies anywhere in memory, and has come by then.
  static constexpr std::size_t pickedAtOnce = 256;

  static std::shared_ptr<Surface> surfaceOf(const CompiledScene& scene);
  double shareOf(std::size_t triangle) const {
    return surface_->shares[triangle] / (thinned_[triangle] ? thinning : 1.0);
  }
  /// Of the order's triangles from `first` on; `sum` is the running one of the pass.
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
  std::vector<Picked> picked_;  ///< of the stretch of the order at hand
  std::vector<Place> places_;   ///< of the triangle at hand
};

}  // namespace prelight
