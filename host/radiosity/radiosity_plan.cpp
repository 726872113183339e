#include "radiosity/radiosity_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "radiosity/elements.h"

namespace prelight {

namespace {

constexpr std::uint64_t bytesPerEntry = 28;  // counts both ways, both orders, and the joined rows
constexpr std::uint64_t leastRays = 64, mostRays = 32768;

bool shines(const glm::vec3& c) { return c.x > 0.0f || c.y > 0.0f || c.z > 0.0f; }

bool hasLight(const CompiledScene& scene, const BakeRequest& request) {
  return request.radiosityShape.environment != nullptr ||
         std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light& light) { return shines(light.intensity); }) ||
         std::any_of(scene.triangleMaterials.begin(), scene.triangleMaterials.end(),
                     [&](std::uint32_t m) { return shines(scene.materials[m].emission); });
}

bool reflects(const CompiledScene& scene) {
  return scene.hasDiffuseTransmission() ||
         std::any_of(scene.triangleMaterials.begin(), scene.triangleMaterials.end(),
                     [&](std::uint32_t m) { return shines(scene.materials[m].albedo); });
}

double patchSizeOf(const CompiledScene& scene, const BakeRequest& request) {
  const double asked = request.radiosityShape.patchSize;
  return asked > 0.0 ? asked : defaultPatchSize(scene);
}

}  // namespace

std::uint32_t radiosityRays(const CompiledScene& scene, const BakeRequest& request) {
  if (!reflects(scene)) return leastRays;
  auto rays = std::bit_floor(static_cast<std::uint32_t>(std::clamp(request.rays / 2, leastRays, mostRays)));
  const std::uint64_t elements = makeElements(scene, patchSizeOf(scene, request)).perSide();
  while (rays > leastRays &&
         elements * std::min<std::uint64_t>(rays, elements) * bytesPerEntry > request.maxMemory)
    rays /= 2;
  return rays;
}

void checkRadiosityMemory(const CompiledScene& scene, const BakeRequest& request) {
  const std::uint64_t elements = makeElements(scene, patchSizeOf(scene, request)).perSide();
  const std::uint64_t bytes =
      elements * std::min<std::uint64_t>(radiosityRays(scene, request), elements) * bytesPerEntry;
  if (bytes > request.maxMemory)
    throw Error(
        ExitCode::OutOfMemory, "--radiosity",
        fmt::format("form factors of {} elements take about {} MB, more than the {} MB of --max-memory",
                    elements, bytes >> 20, request.maxMemory >> 20),
        "take larger patches (--patch-size), or raise --max-memory");
}

std::uint64_t radiosityBytes(const CompiledScene& scene, const BakeRequest& request) {
  const std::uint64_t elements = makeElements(scene, patchSizeOf(scene, request)).perSide();
  return std::min(
      request.maxMemory,
      elements * std::min<std::uint64_t>(radiosityRays(scene, request), elements) * bytesPerEntry);
}

std::vector<PlannedPass> planRadiosity(const CompiledScene& scene, const BakeRequest& request) {
  const std::string lack = !request.radiosity ? "not asked for"
                           : !hasLight(scene, request)
                               ? "nothing in the scene shines and no sky is given: irradiance is 0"
                               : "";
  if (!lack.empty())
    return {{"radiosity", false, lack}, {"form factors", false, "they matter to radiosity alone"}};
  const RadiosityRequest& shape = request.radiosityShape;
  const double patchSize = patchSizeOf(scene, request);
  const RadiosityElements elements = makeElements(scene, patchSize);
  const std::uint32_t rays = radiosityRays(scene, request);
  const std::uint64_t cut = elements.perSide() - scene.triangleCount();
  PlannedPass factors{"form factors", reflects(scene), ""};
  factors.reason =
      factors.runs
          ? fmt::format("{} rays from each of {} elements of at most {:.3g} m{}", rays, elements.perSide(),
                        patchSize, cut > 0 ? ", as large triangles are cut" : ", which are the triangles")
          : "no surface reflects: direct light alone";
  return {{"radiosity", true,
           fmt::format("direct light by shadow rays, then {} to a residual of {:g}",
                       radiosityMethodNames[static_cast<std::size_t>(shape.method)], shape.tolerance)},
          factors};
}

}  // namespace prelight
