#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/bake.h"
#include "techniques/haar/haar_relight.h"

namespace prelight::benchmarks {

/// Receivers on a plane of finite size and on balls above it, which shadow one another. Exact rays through
/// the centres of texels decide visibility.
class SphereReceivers {
 public:
  /// Makes `count` receivers, half of them on the plane and half on `balls` balls at random places.
  SphereReceivers(int count, int balls, std::uint32_t seed);

  std::size_t count() const { return places_.size(); }
  const glm::dvec3& normal(std::size_t receiver) const { return places_[receiver].normal; }

  /// Returns whether a receiver sees the sky in a direction.
  bool seesSky(std::size_t receiver, const glm::dvec3& direction) const;

  /// Returns the transfer of a receiver's texels: visibility x integral of the clamped cosine over pi.
  std::vector<float> texelTransfer(std::size_t receiver, const CubeTexels& texels) const;

  /// Returns the transfer of all receivers in Haar coefficients, up to a relative L2 error.
  HaarTransfer transfer(const CubeTexels& texels, double relativeError) const;

  /// Returns, per receiver, the receivers nearest to the points of the scene that it sees, with the albedo
  /// there.
  std::vector<std::vector<haar::Link>> links(const CubeTexels& texels) const;

 private:
  struct Ball {
    glm::dvec3 centre;
    double radius;
    glm::vec3 albedo;
  };
  struct Place {
    glm::dvec3 point;
    glm::dvec3 normal;
  };
  /// Distance along a ray to its hit, and the object: a ball's index, or balls_.size() for the plane.
  struct Hit {
    double distance;
    std::size_t thing;
  };

  bool hit(std::size_t receiver, const glm::dvec3& direction, Hit& nearest) const;
  std::uint32_t nearestReceiver(const glm::dvec3& point, const glm::dvec3& normal) const;

  std::vector<Ball> balls_;
  std::vector<Place> places_;
};

}  // namespace prelight::benchmarks
