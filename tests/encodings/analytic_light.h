#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "encodings/encoding.h"

namespace prelight::test {

/// Incident radiance in closed form, relative to the frame of a surface: z is its normal.
struct AnalyticLight {
  std::string name;
  std::function<glm::dvec3(const glm::dvec3&)> radiance;
};

/// What arrives at surfaces: nothing from below; sky, walls, lamps and mixtures of them, in several colours.
std::vector<AnalyticLight> surfaceLights();

/// The same radiance from everywhere, above and below.
AnalyticLight constantLight(const glm::dvec3& radiance);

/// A lamp `degrees` wide, of irradiance 1, `tilt` degrees from the surface's normal.
AnalyticLight lamp(double degrees, double tilt);

/// Sums over a grid of the sphere, in double precision: no function of the library but values of SH.
class LightSum {
 public:
  LightSum(const AnalyticLight& light, const glm::dmat3& frame);

  /// As Encoding::encode() takes it.
  std::vector<float> incident() const;

  /// W/m2, for a unit normal in world space.
  glm::dvec3 irradiance(const glm::dvec3& normal) const;

 private:
  struct Sample {
    glm::dvec3 direction;  ///< world
    glm::dvec3 power;      ///< radiance x solid angle
  };
  std::vector<Sample> samples_;
};

/// Irradiance of radiance in SH as Encoding::encode() takes it: order 5 after the clamped cosine, whose
/// factors are written out.
glm::dvec3 irradianceOfBands(const std::vector<float>& incident, const glm::dvec3& normal);

/// A frame that no axis of the world is parallel to.
glm::dmat3 obliqueFrame();

/// Normals in world space up to `degrees` from the frame's, evenly spread by solid angle.
std::vector<glm::dvec3> normalsWithin(double degrees, const glm::dmat3& frame, int count);

}  // namespace prelight::test
