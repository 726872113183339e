#include "radiosity/radiosity_bake.h"

#include <fmt/format.h>

#include <algorithm>

#include "radiosity/radiosity_plan.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

std::string noteOf(const RadiosityReport& report) {
  return fmt::format(
      "radiosity: {} elements of at most {:.3g} m, {:.0f} form factors per row, {} iterations of {} to a "
      "residual of {:.2g}{}",
      report.elements, report.patchSize,
      double(report.entries) / double(std::max<std::uint64_t>(1, report.elements)), report.solve.sweeps(),
      radiosityMethodNames[static_cast<std::size_t>(report.method)], report.solve.residual(),
      report.solve.converged ? "" : ", which is not what was asked for");
}

}  // namespace

RadiosityOptions radiosityOptions(const CompiledScene& scene, const BakeRequest& request) {
  const RadiosityScale scale = radiosityScale(scene, request);
  checkRadiosityMemory(scale, request);
  RadiosityOptions options;
  options.patchSize = scale.patchSize;
  options.raysPerElement = scale.rays;
  options.seed = request.seed;
  options.maxMemory = request.memory();
  options.method = request.radiosity.method;
  options.tolerance = request.radiosity.tolerance;
  return options;
}

RadiosityBake::RadiosityBake(const CompiledScene& scene, const BakeRequest& request, Tracer& tracer)
    : scene_(scene), request_(request), radiosity_(scene, tracer, radiosityOptions(scene, request)) {}

std::vector<glm::vec3> RadiosityBake::run(const FitMesh& mesh, Progress& progress, BakeReport& report) {
  radiosity_.cast(progress);
  const RadiosityRequest& shape = request_.radiosity;
  radiosity_.relight({scene_.lights, shiningSky(shape.environment.get()), shape.skyRotation}, progress);
  std::vector<glm::vec3> irradiance = radiosity_.irradianceOfVertices(mesh, progress);
  const RadiosityReport& made = radiosity_.report();
  report.radiosity = made;
  report.rays += made.castRays + made.directRays;
  report.stageSeconds.emplace_back("form factors", made.castSeconds + made.rowSeconds);
  report.stageSeconds.emplace_back("direct light", made.directSeconds);
  report.stageSeconds.emplace_back("solve", made.solveSeconds);
  report.notes.push_back(noteOf(made));
  return irradiance;
}

}  // namespace prelight
