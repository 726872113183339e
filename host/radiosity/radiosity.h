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

struct RadiosityOptions {
  double patchSize = 0.0;              ///< m; 0: defaultPatchSize()
  std::uint32_t raysPerElement = 512;  ///< a power of two, 64 to 32768
  std::uint64_t seed = 0;
  std::uint64_t maxMemory = std::uint64_t{2} << 30;  ///< bytes that form factors may take
  RadiosityMethod method = RadiosityMethod::GaussSeidel;
  double tolerance = 1e-4;  ///< of the residual, see ResidualPoint
  double maxSweeps = 1000.0;
};

/// Irradiance of vertices' fronts as it fits best when it is interpolated, W/m2, [vertex]; of any sign, so
/// that sums and multiples of lights are those of their fits.
struct VertexLight {
  std::vector<glm::vec3> direct, indirect;
};

/// The sum of lights times their factors, [light], at the vertices, >= 0. There is one light or more.
std::vector<glm::vec3> irradianceOf(std::span<const VertexLight> lights, std::span<const glm::vec3> factors);

/// Light of emissive triangles at the points of a Radiosity's elements.
struct EmittersLight {
  bool areMany = false;           ///< DirectLight::manyEmitters
  std::vector<glm::vec4> points;  ///< PointIrradiance::emitters, [of lit elements][point]
};

/// A radiosity solution (Goral et al. 1984; Sherif 2013, 4.2): everything that a scene's surfaces exchange
/// diffusely is found once, then lights can move at will. Emission is not among the unknowns: it is direct
/// light.
class Radiosity {
 public:
  /// `scene` and `tracer` outlive it. The scene has a triangle.
  Radiosity(const CompiledScene& scene, Tracer& tracer, const RadiosityOptions& options);

  /// Casts the form factors. Throws Interrupted.
  void cast(Progress& progress);

  /// Direct light of these lights and the emissive triangles. No form factor is found anew. Throws
  /// Interrupted.
  void setLights(const RadiosityLights& lights, Progress& progress);

  /// Solves until the tolerance is met or for `maxSweeps`, whichever comes first, from where the last
  /// solution stands. Throws Interrupted.
  const SolveReport& solve(Progress& progress, std::optional<double> maxSweeps = std::nullopt);

  /// The next solution starts from this irradiance of elements.
  void startFrom(const std::vector<glm::vec4>& irradiance) { solver_->startFrom(irradiance); }

  /// Sets lights and solves.
  const SolveReport& relight(const RadiosityLights& lights, Progress& progress);

  /// W/m2, [element], with direct light; w is 0.
  std::vector<glm::vec4> irradianceOfElements() const { return solver_->irradiance(); }

  /// The direct light of the last lights, W/m2, [element].
  const std::vector<glm::vec4>& directOfElements() const { return directElements_; }

  /// W/m2 at the vertices' fronts, >= 0: what fits best when it is interpolated. Direct light is fitted to
  /// points all over the elements, indirect light to the elements' centres.
  std::vector<glm::vec3> irradianceOfVertices(const FitMesh& mesh, const Progress& progress) const;

  /// The same before it is added up.
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
  std::vector<std::uint32_t> lit_;    ///< elements that have points that count
  std::vector<std::uint32_t> valid_;  ///< parallel to lit_: ExchangeCounts::valid
  std::optional<DirectLight> directLight_;
  std::optional<EmittersLight> emitters_;  ///< none: not found yet
  std::vector<glm::vec4> directPoints_;    ///< [of lit_][point], without what rows carry
  std::vector<glm::vec4> pointMeans_;      ///< [element], of those
  std::vector<glm::vec4> directElements_;  ///< [element]
  std::optional<ExchangeSystem> system_;
  std::optional<ExchangeSolver> solver_;
  RadiosityReport report_;
};

}  // namespace prelight
