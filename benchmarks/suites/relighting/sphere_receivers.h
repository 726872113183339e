#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/bake.h"
#include "techniques/haar/haar_relight.h"

namespace prelight::benchmarks {

/// Receivers on a plane of finite size and on balls above it, all of which block light from each other. What
/// is visible is decided by exact rays at the centres of texels.
class SphereReceivers {
 public:
  /// `count` receivers, half of them on the plane, below and on `balls` balls at random places.
  SphereReceivers(int count, int balls, std::uint32_t seed);

  std::size_t count() const { return places_.size(); }
  const glm::dvec3& normal(std::size_t receiver) const { return places_[receiver].normal; }

  /// True when the receiver sees the sky in the direction.
  bool seesSky(std::size_t receiver, const glm::dvec3& direction) const;

  /// Transfer of the receiver's texels, visibility times the integral of the clamped cosine over pi.
  std::vector<float> texelTransfer(std::size_t receiver, const CubeTexels& texels) const;

  /// The texels' transfer of all receivers in Haar coefficients, up to a relative L2 error.
  HaarTransfer transfer(const CubeTexels& texels, double relativeError) const;

  /// The nearest receivers of what each receiver sees of the scene, with the albedo of what it sees.
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
  /// Distance along a ray and what it meets: a ball's index, or balls_.size() for the plane.
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
