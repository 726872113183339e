#include "bake/drawn_hemispheres.h"

#include <fmt/format.h>

#include "options/shared_bake_options.h"
#include "prelight/hemisphere_renderer.h"
#include "scene/closed_bodies.h"
#include "techniques/registry/registry.h"

namespace prelight {

namespace {

constexpr const char* visibilityField = "BakeRequest::visibility";

/// Throws about a part of a request that drawn views do not serve.
[[noreturn]] void refuse(const std::string& what, const std::string& hint) {
  throw UsageError(visibilityField, "drawn views tell which directions are open and no more, but " + what,
                   hint);
}

/// Returns whether a pass of a technique that is not drawable runs.
bool tracesRays(const Technique& technique, const PlanInput& input) {
  if (technique.plan.drawable || technique.plan.passes == nullptr) return false;
  for (const PlannedPass& pass : technique.plan.passes(input))
    if (pass.runs) return true;
  return false;
}

}  // namespace

void requireDrawable(const PlanInput& input) {
  const BakeRequest& request = input.request;
  const auto refuseGiven = [](bool given, const std::string& what) {
    if (given) refuse(what + " needs more", "leave out " + what + ", or trace rays");
  };
  for (const Option<BakeRequest>& row : lightOptions()) refuseGiven(row.isSet(request), row.field);
  refuseGiven(request.limits.nearest > 0.0, "OcclusionLimits::nearest");
  refuseGiven(request.limits.farthest > 0.0, "OcclusionLimits::farthest");
  refuseGiven(request.limits.obscurance > 0.0, "OcclusionLimits::obscurance");
  refuseGiven(!request.shadowSets.empty(), "BakeRequest::shadowSets");
  for (const Technique& technique : techniques())
    if (tracesRays(technique, input))
      refuse(std::string(technique.name) + " follows rays",
             "bake it by rays; AO, cones, SH and CH can be drawn");
}

std::string drawnCastReason(const PlanInput& input) {
  const double views =
      double(input.request.effort.rays) * input.scene.vertexCount() / HemisphereRenderer::directions;
  const double triangles = input.scene.triangleCount();
  const bool open = input.request.effort.error || input.request.effort.seconds;
  std::string text = fmt::format(
      "views of receivers are drawn, no ray is traced: {} {:.0f} views of {:.0f} triangles, which are {:.3g} "
      "triangles for each ray of a bake by rays; worth it only where OpenGL draws that many faster than the "
      "device traces a ray, as a GPU may and a processor does not",
      open ? "at least" : "about", views, triangles, triangles / HemisphereRenderer::directions);
  if (!trianglesOfEnteredSolids(input.scene).empty())
    text += "; rays find the receivers that lie inside of objects, because some objects enter others";
  return text;
}

UsageError rendererMissing() {
  return UsageError(
      visibilityField, "views of receivers are to be drawn, and nothing is at hand that draws them",
      "trace rays; or use the program prelight of a build with the viewer (PRELIGHT_VIEWER=ON), "
      "or in C++ openGlHemispheres() of prelight/draw.h among the options of bake()");
}

}  // namespace prelight
