#include <algorithm>
#include <cmath>

#include "basis/median_cut.h"
#include "images/averaged_sky.h"
#include "images/sky_lamps.h"
#include "scene/camera.h"
#include "viewer/core/camera.h"
#include "viewer/lights/drawn_sky.h"
#include "viewer/lights/lobe_map.h"
#include "viewer/programs/shader_variant.h"
#include "viewer/techniques/near_lamps/near_lamp_pass.h"
#include "viewer/web/page_parts.h"

namespace prelight::viewer {
namespace {

using Json = nlohmann::ordered_json;

constexpr int areaSamples = 16;  ///< that stand for an area light where no closed form does

Json describe(const ShadedLight& light) {
  Json json = {{"kind", static_cast<int>(light.kind)},
               {"intensity", numbersOf(light.intensity)},
               {"position", numbersOf(light.position)},
               {"direction", numbersOf(light.direction)},
               {"range", light.range},
               {"cone", {light.coneScale, light.coneOffset}},
               {"profileStart", light.profileStart},
               {"entry", light.entry},
               {"area", light.area},
               {"radius", light.radius},
               {"leastDistance", light.leastDistance},
               {"twoSided", light.twoSided},
               {"throughTransfer", light.throughTransfer},
               {"shadow", light.shadow},
               {"isSample", light.isSample}};
  const device::OccluderLight occluder = occluderLight(light);  // profiles and cookies as their means
  json["mean"] = Json::array({occluder.intensity[0], occluder.intensity[1], occluder.intensity[2]});
  if (light.kind != LightKind::Area) return json;
  for (const ShadedLight& sample : samplesOf(light, areaSamples)) json["samples"].push_back(describe(sample));
  for (const ShadedLight& part : samplesOf(light, NearLampPass::placesOfAnArea))
    if (light.shadow >= 0) json["shadowPlaces"].push_back(describe(part));
  return json;
}

/// Coefficients of a sky, and the strengths of what smooths it, by orders of shadings that look at it.
Json describe(const SkyCoefficients& sky, std::span<const int> orders) {
  Json coefficients = Json::array(), smoothing = Json::object();
  const int most = std::ranges::max(orders);
  for (const glm::dvec3& c : sky.turned(0.0, most)) coefficients.push_back(numbersOf(c));
  for (const int order : orders) smoothing[std::to_string(order)] = sky.smoothing(order).lambda;
  return {{"coefficients", coefficients}, {"smoothing", smoothing}};
}

/// The lamps of a sky, and the sky beside them.
Json describe(const LampsAndSky& parts, std::span<const int> orders) {
  Json lamps = Json::array();
  for (const SkyLamp& lamp : parts.lamps)
    lamps.push_back({{"direction", numbersOf(lamp.direction)},
                     {"radius", lamp.radius},
                     {"irradiance", numbersOf(lamp.irradiance)}});
  return {{"lamps", lamps},
          {"rest", describe(SkyCoefficients(parts.rest, std::ranges::max(orders)), orders)}};
}

/// Adds the sky through the lobes of rough surfaces.
Json addLobes(const Environment& sky, const std::string& array, PageData& data) {
  std::vector<glm::vec3> texels;
  for (const std::vector<glm::vec3>& level : makeLobeMap(sky).levels)
    texels.insert(texels.end(), level.begin(), level.end());
  data.addColors(array, texels);
  return {{"array", array}, {"width", LobeMap::width}};
}

bool reflectsSkies(const RenderInputs& inputs) {
  return std::ranges::any_of(surfacesOf(inputs), [](const Surface& surface) {
    return featuresOf(surface).has(Feature::Gloss) || featuresOf(surface).has(Feature::Layer);
  });
}

Json describe(const PageSky& sky, const std::string& array, std::span<const int> orders, PageData& data) {
  const Environment map = averagedTo(sky.map, mostSkyWidth);
  data.addColors(array, map.radiance);
  Json lights = Json::array();
  for (const SkyLight& part : medianCut(sky.map, defaultSkyLights))
    lights.push_back({{"direction", numbersOf(part.direction)}, {"irradiance", numbersOf(part.irradiance)}});
  Json json = {
      {"name", sky.name}, {"array", array}, {"width", map.width}, {"height", map.height}, {"lights", lights}};
  json.update(describe(SkyCoefficients(sky.map, std::ranges::max(orders)), orders));
  if (const LampsAndSky parts = takeLampsOut(sky.map); !parts.lamps.empty())
    json["apart"] = describe(parts, orders);
  return json;
}

}  // namespace

void addCameras(const RenderInputs& inputs, PageScene& page) {
  Json list = Json::array();
  const auto add = [&](const Camera& camera) {
    Camera scene = camera;
    scene.world[3] = glm::dvec4(glm::dvec3(camera.world[3]) - inputs.compiled.origin, 1.0);
    list.push_back({{"name", camera.name},
                    {"world", numbersOf(scene.world)},
                    {"perspective", camera.perspective},
                    {"yFov", camera.yFov},
                    {"yMag", camera.yMag},
                    {"zNear", camera.zNear},
                    {"zFar", camera.zFar}});
  };
  for (const Camera& camera : inputs.scene.cameras) add(camera);
  if (list.empty()) add(chooseCamera(inputs.scene, inputs.compiled, std::nullopt, 1.0));
  const BoundingSphere sphere = boundingSphere(inputs.compiled);
  page.description["cameras"] = list;
  page.description["sphere"] = {{"centre", numbersOf(sphere.centre)},
                                {"radius", sphere.radius},
                                {"reach", sphereSlack * sphere.radius}};
  page.description["bounds"] = {numbersOf(inputs.compiled.boundsMin), numbersOf(inputs.compiled.boundsMax)};
}

void addLights(const RenderInputs& inputs, PageScene& page) {
  ViewLights all(inputs.compiled);
  View view;
  view.shading = Shading::Sh;
  view.lights = inputs.scene.lights;
  std::vector<ShadedLight> lights = all.of(view, {});
  if (inputs.bake->nearLamps) NearLampPass::choose(lights, inputs.compiled);
  Json list = Json::array();
  for (const ShadedLight& light : lights) list.push_back(describe(light));
  for (std::size_t i = 0; i < std::min(view.lights.size(), lights.size()); ++i)
    if (!lights[i].isSample) list[i]["name"] = view.lights[i].name;
  page.description["lights"] = list;
  if (!all.tables().texels().empty())
    page.data.addFloats("lampTables", std::span<const glm::vec4>(all.tables().texels()));
}

void addSkies(const PageContents& contents, PageScene& page) {
  const std::vector<int> orders = skyOrdersOf(contents.inputs.bake);
  const bool reflected = reflectsSkies(contents.inputs);
  Json list = Json::array();
  for (std::size_t i = 0; i < contents.skies.size(); ++i) {
    const std::string array = "sky" + std::to_string(i);
    const Environment& map = contents.skies[i].map;
    list.push_back(describe(contents.skies[i], array, orders, page.data));
    if (reflected && (map.width > 1 || map.height > 1))
      list.back()["lobes"] = addLobes(map, array + "Lobes", page.data);
  }
  page.description["skies"] = list;
}

}  // namespace prelight::viewer
