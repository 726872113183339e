#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/sh_rotation.h"
#include "gpu/tracer.h"
#include "occluders/rigid_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"
#include "relight/neighbourhood_grid.h"
#include "relight/object_ball.h"
#include "relight/object_shadow.h"
#include "relight/vertex_lights.h"

namespace prelight {

/// How an object changes the light in the space around it (neighborhood transfer: Sloan, Kautz and Snyder
/// 2002): at places around it matrices from the light far away to what of it the object hides there, and to
/// what the object sends there. Found by rays once; it turns and moves with the object.
class Neighbourhood {
 public:
  static constexpr int mostOrder = 4;  ///< bands of the matrices

  /// What an object does to a point's transfer.
  struct Change {
    std::vector<double> hidden;  ///< [i] that the object takes from it
    std::vector<double> sent;    ///< [channel 3][i] that it adds; empty: the object sends nothing
    double factor = 0.0;         ///< share of the cosine-weighted hemisphere that the object hides
    std::vector<float> work;
  };

  /// `whole` is the scene with the object, `own` transfer of its vertices without the scene, as it is turned
  /// there.
  Neighbourhood(const CompiledScene& scene, const VertexRange& range, const HarmonicTransfer& own,
                const Tracer& whole, int order);

  int order() const { return order_; }

  /// The object is at another place.
  void follow(const CompiledScene& scene);

  /// Where it is.
  ObjectBall ball() const { return {motion_.point(around_.centre), around_.radius}; }

  /// Of a point with this transfer and normal, both in scene coordinates. `direct` has order()^2 entries.
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
  std::size_t size() const { return columns_ * columns_; }  ///< of a matrix
  std::span<const float> matricesAt(const glm::dvec3& point, std::vector<float>& matrices) const;

  VertexRange range_;
  int order_;
  std::size_t columns_;          ///< order^2
  std::vector<glm::vec3> rest_;  ///< [vertex], where it was found
  ObjectBall around_;            ///< the object there
  NeighbourhoodGrid grid_;
  std::vector<std::uint8_t> inside_;  ///< [place], within the object: nothing is known
  std::size_t parts_;                 ///< what is hidden, and three channels of what is sent if there is any
  std::vector<float> matrices_;       ///< [place][part][i][j] by nearness(), of light j what arrives in i
  RigidMotion motion_;
  sh::ShRotation there_, back_;  ///< to where the object is, and to where it was found
};

/// What objects take from the vertices of a baked scene and send to them, by their neighbourhoods. `direct`:
/// [vertex][i], SH transfer of the vertices without bounces, of that order. A ray through the scene alone for
/// each vertex and object tells whether the object is seen.
ObjectShadow shadowByNeighbourhoods(const CompiledScene& scene, const VertexRange& baked,
                                    std::span<const Neighbourhood> objects, std::span<const float> direct,
                                    Tracer& walls, int order);

}  // namespace prelight
