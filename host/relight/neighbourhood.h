#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/sh_rotation.h"
#include "gpu/tracer.h"
#include "occluders/rigid_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"
#include "relight/object_shadow.h"
#include "relight/vertex_lights.h"

namespace prelight {

/// Places around an object at the crossings of planes perpendicular to the three axes: dense at the object,
/// then with increasing distances.
class NeighbourhoodGrid {
 public:
  /// `halves` are the half extents of the object's bounds; `radius` is that of its ball.
  NeighbourhoodGrid(const glm::dvec3& centre, const glm::dvec3& halves, double radius);

  std::size_t count() const;
  glm::dvec3 placeOf(std::size_t index) const;

  struct Corner {
    std::size_t place = 0;
    double weight = 0.0;
  };

  /// Returns the places and weights for interpolation at a point. Points beyond all planes are moved straight
  /// towards the centre.
  std::array<Corner, 8> cornersAt(const glm::dvec3& point) const;

 private:
  glm::dvec3 centre_;
  std::array<std::vector<double>, 3> planes_;  ///< [axis], ascending, relative to the centre
};

/// The effect of an object on light in the space around it (neighborhood transfer: Sloan, Kautz and Snyder
/// 2002): matrices, at places around it, from distant light to the light that it hides there and to the light
/// that it sends there. They are computed once by rays and move and turn with the object.
class Neighbourhood {
 public:
  static constexpr int mostOrder = 4;  ///< bands of the matrices

  /// The effect of an object on a point's transfer.
  struct Change {
    std::vector<double> hidden;  ///< [i], subtracted by the object
    std::vector<double> sent;    ///< [channel 3][i], added by the object; empty: nothing
    double factor = 0.0;         ///< share of the cosine-weighted hemisphere that the object covers
    std::vector<float> work;
  };

  /// `whole` is the scene with the object. `own` is the transfer of its vertices without the scene, in its
  /// present orientation.
  Neighbourhood(const CompiledScene& scene, const VertexRange& range, const HarmonicTransfer& own,
                const Tracer& whole, int order);

  int order() const { return order_; }

  /// Updates the object's position.
  void follow(const CompiledScene& scene);

  /// Returns the object's ball at its present position.
  ObjectBall ball() const { return {motion_.point(around_.centre), around_.radius}; }

  /// Computes the effect on a point with this transfer and normal, in scene coordinates. `direct` has
  /// order()^2 entries.
  void change(const glm::dvec3& point, const glm::dvec3& normal, std::span<const double> direct,
              Change& change) const;

 private:
  using Corners = std::array<NeighbourhoodGrid::Corner, 8>;

  void cast(const CompiledScene& scene, const HarmonicTransfer& own, Tracer& alone);
  void addPlace(const CompiledScene& scene, const HarmonicTransfer& own, std::size_t place,
                std::span<const device::Ray> rays, std::span<const device::Hit> hits);
  void addSent(const CompiledScene& scene, const HarmonicTransfer& own, const device::Hit& hit, double weight,
               std::span<const double> values, std::span<float> sent) const;
  double nearness(const glm::dvec3& point) const;
  Corners cornersAt(const glm::dvec3& point) const;
  std::size_t size() const { return columns_ * columns_; }  ///< entries of a matrix
  std::span<const float> matricesAt(const glm::dvec3& point, std::vector<float>& matrices) const;

  VertexRange range_;
  int order_;
  std::size_t columns_;          ///< order^2
  std::vector<glm::vec3> rest_;  ///< [vertex], position when the matrices were computed
  ObjectBall around_;            ///< the object's ball at that position
  NeighbourhoodGrid grid_;
  std::vector<std::uint8_t> inside_;  ///< [place], inside the object: nothing is known
  std::size_t parts_;                 ///< hidden light, and three channels of sent light if there is any
  std::vector<float> matrices_;       ///< [place][part][i][j] times nearness(), arriving i per light j
  RigidMotion motion_;
  sh::ShRotation there_, back_;  ///< to the object's present orientation, and back to the original one
};

/// Returns the effect of objects on the vertices of a baked scene by their neighbourhoods. `direct`,
/// [vertex][i], is the SH transfer of the vertices without bounces in that order. One ray per vertex and
/// object, through the scene without objects, decides whether the object is visible.
ObjectShadow shadowByNeighbourhoods(const CompiledScene& scene, const VertexRange& baked,
                                    std::span<const Neighbourhood> objects, std::span<const float> direct,
                                    Tracer& walls, int order);

}  // namespace prelight
