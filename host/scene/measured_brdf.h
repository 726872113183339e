#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "prelight/error.h"
#include "prelight/load.h"
#include "prelight/measured_brdf.h"

namespace prelight {

/// A half vector and the solid angle around it that it represents.
struct HalfVector {
  glm::dvec3 direction;
  double weight;
};

/// Returns half vectors over the hemisphere of +Z, two per angle of MeasuredBrdf's cells: dense where the
/// cells are narrow, as lobes may be there.
inline std::vector<HalfVector> halfVectors() {
  using std::numbers::pi;
  constexpr int steps = 2 * MeasuredBrdf::halves, azimuths = 64;
  std::vector<HalfVector> samples;
  for (int i = 0; i < steps; ++i) {
    const double root = (i + 0.5) / steps, theta = 0.5 * pi * root * root;
    const double weight = pi * root / steps * std::sin(theta) * 2.0 * pi / azimuths;
    for (int k = 0; k < azimuths; ++k) {
      const double turn = 2.0 * pi * (k + 0.5) / azimuths;
      samples.push_back(
          {{std::sin(theta) * std::cos(turn), std::sin(theta) * std::sin(turn), std::cos(theta)}, weight});
    }
  }
  return samples;
}

/// Returns a direction of this cosine with +Z, and y = 0.
inline glm::dvec3 directionOfCosine(double cosine) { return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine}; }

/// Calls use(wi, half vector, solid angle of wi) for directions above the surface that reflect to wo.
template <typename Use>
void forReflected(const std::vector<HalfVector>& samples, const glm::dvec3& wo, const Use& use) {
  for (const HalfVector& h : samples) {
    const double along = glm::dot(wo, h.direction);
    const glm::dvec3 wi = 2.0 * along * h.direction - wo;
    if (along > 0.0 && wi.z > 0.0) use(wi, h.direction, h.weight * 4.0 * along);
  }
}

/// Cells of MeasuredBrdf, in the frame of a surface whose normal is +Z. A value belongs to the centre of its
/// cell; between centres, values are interpolated.

/// Returns the index of a cell.
std::size_t brdfCell(int half, int difference, int turn);

/// Returns the interpolated value of the cells for light from wi to wo, both unit and above the surface.
glm::dvec3 brdfAt(std::span<const glm::vec3> cells, const glm::dvec3& wo, const glm::dvec3& wi);

/// Returns the cosines with the normal of the two directions at the centre of a cell; a negative one lies
/// below the surface.
glm::dvec2 cosinesOfCell(int half, int difference, int turn);

/// Returns a material for measured values, [half][difference][turn], 1/sr, which are below 0 where there are
/// none: those are filled from neighbours. Where more light would leave than arrives, the values are scaled
/// by factors of both directions, so that they stay reciprocal. Warns of both if the changes are large.
/// Throws InputError if there are no values.
MeasuredBrdf makeMeasuredBrdf(std::vector<glm::vec3> values, const std::string& where, Warnings& warnings);

/// Reads a file in MERL's format and makes a material of it. Throws InputError.
std::shared_ptr<const MeasuredBrdf> readMeasured(const std::filesystem::path& file, Warnings& warnings);

/// Returns the interpolated MeasuredBrdf::albedos for a direction of this cosine.
glm::dvec3 albedoAt(const std::vector<glm::vec3>& albedos, double cosine);

/// Makes a material reflect as measured. Its other reflection parameters are replaced by an approximation, a
/// diffuse body and a GGX lobe, which bakes and rasterised pictures show. Coverage, bumps and emission are
/// unchanged.
void setMeasured(const std::shared_ptr<const MeasuredBrdf>& brdf, Material& material);

/// Reads the named files and assigns them to their materials. Throws UsageError for a material that the scene
/// does not have, InputError for a file.
void giveMeasured(Scene& scene, const std::vector<MaterialBrdf>& brdfs, Warnings& warnings);

}  // namespace prelight
