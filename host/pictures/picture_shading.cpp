#include "pictures/picture_shading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "io/baked_sky.h"
#include "pictures/picture_lights.h"
#include "pictures/recorded_sky.h"
#include "scene/light_shape.h"
#include "scene/light_sources.h"
#include "viewer/options/group_option.h"
#include "viewer/options/shading_options.h"

namespace prelight::pictures {
namespace {

/// The largest scene whose photons are traced without being asked for.
constexpr std::size_t mostTracedTriangles = 500'000;

/// The relMSE above which pictures of a bake give way to traced light.
constexpr float mostErrorOfBakes = 0.1f;

/// Returns whether all light of a picture can be traced without being asked for. The pictures of a sequence
/// are drawn from light that is computed once, so that what moves needs a window.
bool canTrace(const PictureRequest& asked, bool window, const CompiledScene& compiled) {
  return compiled.triangleCount() > 0 && compiled.triangleCount() <= mostTracedTriangles &&
         !anyDrawnOnly(asked.render.lights) && asked.causticPhotons == 0 && (window || !asked.pose.plays);
}

bool findsDevice(DrawingSession& session, const PictureRequest& asked) {
  const DeviceOptions options = session.deviceOptions(asked.bake);
  try {
    session.measure("device", [&] { return session.openDevice(options); });
    return true;
  } catch (const Error& error) {
    if (options.selector) throw;
    session.note(fmt::format("direct light alone is drawn: {}", error.what()));
    return false;
  }
}

/// Warns of options that were given although the shading does not use them.
template <typename Options>
void warnOfUnusedOptions(DrawingSession& session, const Options& options, viewer::Shading shading) {
  const std::string_view name = viewer::shadingName(shading);
  for (const Option<Options>& row : optionsOf<Options>()) {
    const std::vector<std::string_view> users = row.shadingNames();
    if (users.empty() || row.appliesTo(name) || row.get(options) == row.usualValue()) continue;
    session.warn(fmt::format("--{}: ignored, because it applies to {} shading, and this is {}", row.name,
                             fmt::join(users, " and "), name));
  }
}

}  // namespace

void checkAreaLights(const PictureRequest& asked, viewer::Shading shading, bool everyShading,
                     const Bake& bake) {
  if (!anyDrawnOnly(asked.render.lights)) return;
  const bool baked = viewer::showsBakedLight(shading) && !viewer::infoOf(shading).carriedBy(bake);
  const bool followed =
      everyShading && (viewer::showsAllLight(shading) || viewer::infoOf(shading).traits.followsLamps);
  if (baked || followed)
    throw UsageError(fmt::format("DrawRequest::shading {}", viewer::shadingName(shading)),
                     fmt::format("{} cannot use area lights and cookies",
                                 followed ? "a window in this shading" : "its bake"),
                     "give the scene an emissive surface, or choose another shading");
  if (asked.causticPhotons > 0)
    throw UsageError("DrawRequest::causticPhotons", "photons start neither from area lights nor from cookies",
                     "give the scene an emissive surface, or leave one of the two out");
}

void checkShadingOptions(DrawingSession& session, const PictureRequest& asked, bool window,
                         const ShadedScene& shaded) {
  const viewer::Shading shading = shaded.render.shading;
  const bool dims = window && viewer::infoOf(shading).traits.followsLamps && !shaded.bake.lightGroups;
  if (!asked.render.groups.empty() && !dims && shading != viewer::Shading::Lights)
    session.warn(
        fmt::format("DrawRequest::groups: ignored, because it applies to lights shading, and this is {}",
                    viewer::shadingName(shading)));
  warnOfUnusedOptions<viewer::ShadingOptions>(session, asked.render, shading);
  warnOfUnusedOptions(session, asked.render, shading);
  warnOfUnusedOptions(session, asked.instant, shading);
  // warnOfOtherSky() compares --env with the sky that a file records.
  const bool sky = (asked.sky || !asked.environment.empty()) && !readBakedSky(*shaded.loaded.document);
  if (viewer::showsBakedLight(shading) && !shaded.run && (asked.render.lights || sky))
    session.warn(
        "DrawRequest::lights, DrawRequest::skyName: the irradiance in the file still comes from the lights "
        "that it was baked with");
  if (shading == viewer::Shading::Lights && asked.render.lights)
    session.warn(
        "DrawRequest::lights: in lights shading only metals reflect such lights; use DrawRequest::groups for "
        "the scene's own");
  if (shaded.bake.lightGroups)
    viewer::groupFactors(viewer::namesOf(*shaded.bake.lightGroups), asked.render.groups);
}

viewer::LightOfPicture lightOfPicture(const PictureRequest& asked, const LoadedScene& loaded,
                                      const Environment* sky, double turn) {
  const std::vector<Light>& lights = asked.render.lights ? *asked.render.lights : loaded.compiled.lights;
  const auto within = [&](const Light& light) {
    return light.type != LightType::Directional && liesWithin(light, loaded.compiled);
  };
  viewer::LightOfPicture light;
  light.inside = !emittersOf(loaded.compiled).empty() || std::ranges::any_of(lights, within);
  light.outside = !std::ranges::all_of(lights, within);
  light.sky = sky != nullptr;
  const bool moved = asked.pose.at.has_value() || !asked.pose.moves.empty() || asked.pose.plays;
  light.asBaked = !asked.render.lights && !moved && isSkyOfBake(loaded, sky, turn);
  return light;
}

viewer::Shading chooseShading(DrawingSession& session, const PictureRequest& asked, bool window,
                              const LoadedScene& loaded, const Bake& bake,
                              const viewer::LightOfPicture& light) {
  const viewer::CarriedShading carried = viewer::carriedShading(bake, light);
  if (carried.error <= mostErrorOfBakes) return carried.shading;
  const bool all = canTrace(asked, window, loaded.compiled) && (light.sky || light.outside || light.inside);
  if (!all || !findsDevice(session, asked)) return carried.shading;
  if (carried.shading != viewer::Shading::Phong)
    session.note(fmt::format(
        "drawn in full shading: the file's bake lacks much of this light (DrawRequest::shading {} shows it)",
        viewer::shadingName(carried.shading)));
  return viewer::Shading::GlobalIllumination;
}

}  // namespace prelight::pictures
