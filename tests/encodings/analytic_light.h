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

/// Light on surfaces, without any from below: sky, walls, lamps and mixtures of them, in several colours.
std::vector<AnalyticLight> surfaceLights();

/// Light of constant radiance from all directions, above and below.
AnalyticLight constantLight(const glm::dvec3& radiance);

/// A lamp `degrees` wide, of irradiance 1, `tilt` degrees from the surface's normal.
AnalyticLight lamp(double degrees, double tilt);

/// Reference sums over a grid of the sphere, in double precision. They use no function of the library except
/// values of SH.
class LightSum {
 public:
  LightSum(const AnalyticLight& light, const glm::dmat3& frame);

  /// Incident radiance in the form that Encoding::encode() takes.
  std::vector<float> incident() const;

  /// Irradiance in W/m2 for a unit normal in world space.
  glm::dvec3 irradiance(const glm::dvec3& normal) const;

 private:
  struct Sample {
    glm::dvec3 direction;  ///< In world space.
    glm::dvec3 power;      ///< Radiance x solid angle.
  };
  std::vector<Sample> samples_;
};

/// Irradiance from radiance in SH in the form that Encoding::encode() takes: order 5, convolved with the
/// clamped cosine, whose factors are written out.
glm::dvec3 irradianceOfBands(const std::vector<float>& incident, const glm::dvec3& normal);

/// A frame with no axis parallel to one of the world.
glm::dmat3 obliqueFrame();

/// Normals in world space within `degrees` of the frame's, evenly spread by solid angle.
std::vector<glm::dvec3> normalsWithin(double degrees, const glm::dmat3& frame, int count);

}  // namespace prelight::test
