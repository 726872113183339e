#include "benchmarks/skip/edits.h"
#include "benchmarks/skip/rows.h"

namespace prelight::benchmarks::skip {

namespace {

void addLight(Setting& setting, Presence presence) {
  if (presence != Presence::Absent)
    setting.scene.lights.push_back(lightInside(glm::vec3(presence == Presence::Needed ? 1.0f : 0.0f)));
}

void addSky(Setting& setting, Presence presence) {
  if (presence != Presence::Absent)
    setting.bake.radiosity.environment = skyOf(presence == Presence::Needed ? 1.0f : 0.0f);
}

Setting lightOfMap(Presence presence, const Effort& effort) {
  Setting setting = lightMapOf("cornell", effort);
  addLight(setting, presence);
  return setting;
}

Setting skyOfMap(Presence presence, const Effort& effort) {
  Setting setting = lightMapOf("cornell", effort);
  addSky(setting, presence);
  return setting;
}

/// No light is absent; one that gives none is not needed.
Setting onlyLightOfMap(Presence presence, const Effort& effort) {
  Setting setting = lightMapOf("cornell", effort);
  takeLightsAway(setting.scene);
  addLight(setting, presence);
  return setting;
}

Setting onlySkyOfMap(Presence presence, const Effort& effort) {
  Setting setting = lightMapOf("cornell", effort);
  takeLightsAway(setting.scene);
  addSky(setting, presence);
  return setting;
}

Setting causticsOfMap(Presence presence, const Effort& effort) {
  Setting setting = lightMapOf(presence == Presence::Needed ? "caustics" : "cornell", effort);
  setting.bake.lightMap.caustics = presence != Presence::Absent;
  return setting;
}

Setting normalMapOfMap(Presence presence, const Effort& effort) {
  Setting setting = lightMapOf("cornell", effort);
  if (presence == Presence::Absent) return setting;
  const int image = addTexture(setting.scene, true);
  if (presence == Presence::Unneeded) setting.scene.materials.emplace_back().normalTexture.image = image;
  if (presence == Presence::Needed)
    for (Material& m : setting.scene.materials) m.normalTexture.image = image;
  return setting;
}

Setting lightOfRadiosity(Presence presence, const Effort& effort) {
  Setting setting = radiosityOf("cornell", effort);
  addLight(setting, presence);
  return setting;
}

Setting skyOfRadiosity(Presence presence, const Effort& effort) {
  Setting setting = radiosityOf("cornell", effort);
  addSky(setting, presence);
  return setting;
}

Setting onlySkyOfRadiosity(Presence presence, const Effort& effort) {
  Setting setting = radiosityOf("cornell", effort);
  takeLightsAway(setting.scene);
  addSky(setting, presence);
  return setting;
}

}  // namespace

std::vector<Row> staticLightRows() {
  return {
      {"light of a light map", "it is black, the lamp shines", "it shines", lightOfMap},
      {"sky of a light map", "it is black, the lamp shines", "it shines", skyOfMap},
      {"only light of a light map", "it is black", "it shines", onlyLightOfMap},
      {"only sky of a light map", "it is black", "it shines", onlySkyOfMap},
      {"caustics of a light map", "nothing reflects or refracts", "a glass sphere, a mirror", causticsOfMap},
      {"normal map of a light map", "of a material that no triangle has", "of every surface", normalMapOfMap},
      {"light of radiosity", "it is black, the lamp shines", "it shines", lightOfRadiosity},
      {"sky of radiosity", "it is black, the lamp shines", "it shines", skyOfRadiosity},
      {"only sky of radiosity", "it is black", "it shines", onlySkyOfRadiosity},
  };
}

}  // namespace prelight::benchmarks::skip
