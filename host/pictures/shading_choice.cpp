#include "pictures/shading_choice.h"

#include <algorithm>

#include "pictures/picture_lights.h"
#include "pictures/recorded_sky.h"
#include "scene/light_shape.h"
#include "scene/light_sources.h"

namespace prelight::pictures {
namespace {

/// The largest scene whose photons are traced without being asked for.
constexpr std::size_t mostTracedTriangles = 500'000;

bool carriesAny(const Bake& bake) {
  return std::ranges::any_of(viewer::shadings(), [&](const viewer::ShadingInfo& info) {
    return !info.bakeOption.empty() && info.carriedBy(bake);
  });
}

}  // namespace

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

viewer::Shading chooseShading(const PictureRequest& asked, const LoadedScene& loaded, const Bake& bake,
                              const viewer::LightOfPicture& light) {
  if (carriesAny(bake)) return viewer::carriedShading(bake, light);
  const bool traceable = loaded.compiled.triangleCount() <= mostTracedTriangles &&
                         !anyDrawnOnly(asked.render.lights) && asked.causticPhotons == 0;
  return light.inside && traceable ? viewer::Shading::GlobalIllumination : viewer::Shading::Phong;
}

}  // namespace prelight::pictures
