#include "radiosity/radiosity_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "prelight/error.h"
#include "radiosity/elements.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

constexpr std::uint64_t bytesPerEntry = 28;  // counts in both directions, both orders, and the combined rows
constexpr std::uint32_t leastRays = 64, mostRays = 32768;

bool hasLight(const CompiledScene& scene, const BakeRequest& request) {
  return shiningSky(request.radiosity.environment.get()) != nullptr || hasLights(scene);
}

}  // namespace

std::uint64_t RadiosityScale::bytes() const {
  return std::uint64_t{elements} * std::min(rays, elements) * bytesPerEntry;
}

RadiosityScale radiosityScale(const CompiledScene& scene, const BakeRequest& request) {
  RadiosityScale scale;
  const double asked = request.radiosity.patchSize;
  scale.patchSize = asked > 0.0 ? asked : defaultPatchSize(scene);
  scale.elements = makeElements(scene, scale.patchSize).perSide();
  scale.rays = leastRays;
  if (!scattersDiffusely(scene)) return scale;
  scale.rays = std::bit_floor(
      static_cast<std::uint32_t>(std::clamp<std::uint64_t>(request.effort.rays / 2, leastRays, mostRays)));
  while (scale.rays > leastRays && scale.bytes() > request.memory()) scale.rays /= 2;
  return scale;
}

void checkRadiosityMemory(const RadiosityScale& scale, const BakeRequest& request) {
  if (scale.bytes() > request.memory())
    throw Error(
        ExitCode::OutOfMemory, "BakeRequest::radiosity",
        fmt::format(
            "form factors of {} elements take about {} MB, more than the {} MB of BakeRequest::maxMemory",
            scale.elements, scale.bytes() >> 20, request.memory() >> 20),
        "raise RadiosityRequest::patchSize or BakeRequest::maxMemory");
}

std::vector<PlannedPass> planRadiosity(const CompiledScene& scene, const BakeRequest& request) {
  const std::string lack =
      !request.radiosity ? "not asked for"
      : !hasLight(scene, request)
          ? "nothing in the scene shines and no sky that shines is given: irradiance is 0"
          : "";
  if (!lack.empty())
    return {{Pass::Radiosity, false, lack}, {Pass::FormFactors, false, "only radiosity uses them"}};
  const RadiosityRequest& shape = request.radiosity;
  const RadiosityScale scale = radiosityScale(scene, request);
  const std::uint32_t cut = scale.elements - scene.triangleCount();
  PlannedPass factors{Pass::FormFactors, scattersDiffusely(scene), ""};
  factors.reason = factors.runs
                       ? fmt::format("{} rays from each of {} elements of at most {:.3g} m{}", scale.rays,
                                     scale.elements, scale.patchSize,
                                     cut > 0 ? ", as large triangles are cut" : ", which are the triangles")
                       : "no surface reflects: direct light alone";
  return {{Pass::Radiosity, true,
           fmt::format("direct light by shadow rays, then {} to a residual of {:g}",
                       radiosityMethodNames[static_cast<std::size_t>(shape.method)], shape.tolerance)},
          factors};
}

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
