#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "prelight/bake.h"
#include "prelight/progress.h"
#include "radiosity/direct_light.h"
#include "radiosity/exchange_solver.h"
#include "radiosity/form_factor_cast.h"
#include "radiosity/form_factors.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Options of a radiosity solution.
struct RadiosityOptions {
  double patchSize = 0.0;              ///< m; 0: defaultPatchSize()
  std::uint32_t raysPerElement = 512;  ///< a power of two, 64 to 32768
  std::uint64_t seed = 0;
  std::uint64_t maxMemory = std::uint64_t{2} << 30;  ///< bytes that form factors may take
  RadiosityMethod method = RadiosityMethod::GaussSeidel;
  double tolerance = 1e-4;  ///< bound of the residual, see ResidualPoint
  double maxSweeps = 1000.0;
};

/// Irradiance of the vertices' fronts that fits best under interpolation, W/m2, [vertex]. Values may be
/// negative, so that sums and multiples of lights are those of their fits.
struct VertexLight {
  std::vector<glm::vec3> direct, indirect;
};

/// Returns the sum of at least one light, each times its factor, [light], at the vertices, >= 0.
std::vector<glm::vec3> irradianceOf(std::span<const VertexLight> lights, std::span<const glm::vec3> factors);

/// Light of emissive triangles at the points of the elements.
struct EmittersLight {
  bool areMany = false;           ///< DirectLight::manyEmitters
  std::vector<glm::vec4> points;  ///< PointIrradiance::emitters, [lit element][point]
};

/// A radiosity solution (Goral et al. 1984; Sherif 2013, 4.2): form factors are computed once, and then
/// lights can change at will. Emission is not among the unknowns, as it is part of the direct light.
class Radiosity {
 public:
  /// `scene` and `tracer` must outlive the object. The scene must have a triangle.
  Radiosity(const CompiledScene& scene, Tracer& tracer, const RadiosityOptions& options);

  /// Casts the form factors. Throws Interrupted.
  void cast(Progress& progress);

  /// Computes the direct light of the given lights and the emissive triangles, with the existing form
  /// factors. Throws Interrupted.
  void setLights(const RadiosityLights& lights, Progress& progress);

  /// Solves until the tolerance is met or for `maxSweeps`, whichever comes first, starting from the last
  /// solution. Throws Interrupted.
  const SolveReport& solve(Progress& progress, std::optional<double> maxSweeps = std::nullopt);

  /// Sets the initial irradiance of the next solution, [element].
  void startFrom(const std::vector<glm::vec4>& irradiance) { solver_->startFrom(irradiance); }

  /// Sets lights and solves.
  const SolveReport& relight(const RadiosityLights& lights, Progress& progress);

  /// Returns irradiance including direct light, W/m2, [element]; w is 0.
  std::vector<glm::vec4> irradianceOfElements() const { return solver_->irradiance(); }

  /// Returns the direct light of the last lights, W/m2, [element].
  const std::vector<glm::vec4>& directOfElements() const { return directElements_; }

  /// Returns irradiance at the vertices' fronts, W/m2, >= 0, that fits best under interpolation. Direct light
  /// is fitted to points on the elements, indirect light to the elements' centres.
  std::vector<glm::vec3> irradianceOfVertices(const FitMesh& mesh, const Progress& progress) const;

  /// Returns direct and indirect light at the vertices separately, without clamping.
  VertexLight lightOfVertices(const FitMesh& mesh, const Progress& progress) const;

  const ExchangeSystem& system() const { return *system_; }
  const RadiosityReport& report() const { return report_; }

 private:
  void makeRows();
  std::vector<glm::vec4> emissionThroughRows(std::vector<float>& share) const;
  std::vector<PointIrradiance> estimateDirect(const RadiosityLights& lights, Progress& progress);
  void sumPoints(const std::vector<PointIrradiance>& points, bool manyEmitters);
  std::vector<float> fitDirect(const FitMesh& mesh, double meanArea, const Progress& progress) const;
  std::vector<float> fitIndirect(const FitMesh& mesh, double meanArea, const Progress& progress) const;

  const CompiledScene& scene_;
  Tracer& tracer_;
  RadiosityOptions options_;
  RadiosityElements elements_;
  std::optional<FormFactorCast> cast_;
  FormFactors factors_;
  std::vector<std::uint32_t> lit_;    ///< elements with valid points
  std::vector<std::uint32_t> valid_;  ///< parallel to lit_, ExchangeCounts::valid
  std::optional<DirectLight> directLight_;
  std::optional<EmittersLight> emitters_;  ///< none: not computed yet
  /// [index in lit_][point], without light that form factors contribute.
  std::vector<glm::vec4> directPoints_;
  std::vector<glm::vec4> pointMeans_;      ///< [element], means of directPoints_
  std::vector<glm::vec4> directElements_;  ///< [element]
  std::optional<ExchangeSystem> system_;
  std::optional<ExchangeSolver> solver_;
  RadiosityReport report_;
};

}  // namespace prelight
