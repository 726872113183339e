#include "radiosity/radiosity_plan.h"

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

}  // namespace prelight
