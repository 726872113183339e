#include "pictures/shading_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "io/baked_sky.h"
#include "pictures/picture_lights.h"
#include "viewer/options/group_option.h"

namespace prelight::pictures {
namespace {

/// Returns the shadings that an option applies to, those that show most first.
std::vector<viewer::Shading> shadingsOf(std::string_view option) {
  if (option.starts_with("--")) option.remove_prefix(2);
  std::vector<viewer::Shading> shadings;
  for (const viewer::Shading shading : viewer::shadingsByPreference())
    if (std::ranges::count(viewer::infoOf(shading).options, option) > 0) shadings.push_back(shading);
  return shadings;
}

}  // namespace

void checkAreaLights(const PictureRequest& asked, viewer::Shading shading, bool everyShading,
                     const Bake& bake) {
  if (!anyDrawnOnly(asked.render.lights)) return;
  const bool baked = viewer::showsBakedLight(shading) && !viewer::infoOf(shading).carriedBy(bake);
  const bool followed =
      everyShading && (viewer::showsAllLight(shading) || shading == viewer::Shading::Radiosity);
  if (baked || followed)
    throw UsageError(fmt::format("--shading {}", viewer::shadingName(shading)),
                     fmt::format("{} cannot use area lights and cookies",
                                 followed ? "a window in this shading" : "its bake"),
                     "give the scene an emissive surface, or choose another shading");
  if (asked.causticPhotons > 0)
    throw UsageError("--caustics", "photons start neither from area lights nor from cookies",
                     "give the scene an emissive surface, or leave one of the two out");
}

void checkShadingOptions(DrawingSession& session, const PictureRequest& asked, bool window,
                         const ShadedScene& shaded) {
  const viewer::Shading shading = shaded.render.shading;
  const auto unused = [&](bool given, std::string_view option) {
    const std::vector<viewer::Shading> needed = shadingsOf(option);
    if (!given || std::ranges::count(needed, shading) > 0) return;
    std::vector<std::string_view> names;
    for (const viewer::Shading one : needed) names.push_back(viewer::shadingName(one));
    session.warn(fmt::format("{}: ignored, because it applies to {} shading, and this is {}", option,
                             fmt::join(names, " and "), viewer::shadingName(shading)));
  };
  const bool dims = window && shading == viewer::Shading::Radiosity && !shaded.bake.lightGroups;
  unused(!asked.render.groups.empty() && !dims, "--group");
  unused(asked.render.haarTerms > 0, "--haar-terms");
  unused(asked.render.aoCorrection != viewer::AoCorrection::None, "--ao-correction");
  unused(asked.render.aoFilter != viewer::AoFilter::Cone, "--ao-filter");
  unused(asked.render.horizonSoftness != viewer::defaultHorizonSoftness, "--horizon-softness");
  unused(asked.render.screenOcclusion != viewer::ScreenOcclusionOptions{},
         "an option of screen-space occlusion");
  unused(asked.virtualLights != VirtualLightOptions{}, "an option of instant radiosity");
  unused(asked.render.occluders != viewer::OccluderOptions{}, "an option of vector occluders");
  unused(asked.render.lobe != viewer::Lobe::Ggx, "--lobe");
  // warnOfOtherSky() compares --env with the sky that a file records.
  const bool sky = !asked.environment.empty() && !readBakedSky(shaded.loaded.document);
  if (viewer::showsBakedLight(shading) && !shaded.run && (asked.render.lights || sky))
    session.warn(
        "--light, --env: the irradiance in the file still comes from the lights that it was baked with");
  if (shading == viewer::Shading::Lights && asked.render.lights)
    session.warn(
        "--light: in lights shading only metals reflect such lights; use --group for the scene's own");
  if (shaded.bake.lightGroups)
    viewer::groupFactors(viewer::namesOf(*shaded.bake.lightGroups), asked.render.groups);
}

}  // namespace prelight::pictures
