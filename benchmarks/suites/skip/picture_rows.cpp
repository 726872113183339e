#include "benchmarks/suites/skip/rows.h"

namespace prelight::benchmarks::skip {

namespace {

/// Whether a setting keeps the other lights of its scene.
enum class Others : bool { Dark, Shining };

using MakeSetting = Setting (*)(const std::string& scene, const Effort& effort);

Setting roomOf(MakeSetting make, Others others, const Effort& effort) {
  Setting setting = make("cornell", effort);
  if (others == Others::Dark) takeLightsAway(setting.scene);
  return setting;
}

template <MakeSetting make, Others others>
Setting light(Presence presence, const Effort& effort) {
  Setting setting = roomOf(make, others, effort);
  addLight(setting.scene, presence);
  return setting;
}

template <MakeSetting make, Others others>
Setting sky(Presence presence, const Effort& effort) {
  Setting setting = roomOf(make, others, effort);
  setting.bake.radiosity.environment = skyOf(presence);
  return setting;
}

Setting causticsOfMap(Presence presence, const Effort& effort) {
  Setting setting = lightMapOf(presence == Presence::Needed ? "caustics" : "cornell", effort);
  setting.bake.lightMap.caustics = presence != Presence::Absent;
  return setting;
}

Setting normalMapOfMap(Presence presence, const Effort& effort) {
  Setting setting = lightMapOf("cornell", effort);
  giveTexture(setting.scene, presence, &Material::normalTexture, true);
  return setting;
}

}  // namespace

std::vector<Row> staticLightRows() {
  constexpr MakeSetting map = lightMapOf, radiosity = radiosityOf;
  constexpr Others dark = Others::Dark, shining = Others::Shining;
  const char* blackBeside = "it is black, the lamp shines";
  return {
      {"light of a light map", blackBeside, "it shines", light<map, shining>},
      {"sky of a light map", blackBeside, "it shines", sky<map, shining>},
      {"only light of a light map", "it is black", "it shines", light<map, dark>},
      {"only sky of a light map", "it is black", "it shines", sky<map, dark>},
      {"caustics of a light map", "nothing reflects or refracts", "a glass sphere, a mirror", causticsOfMap},
      {"normal map of a light map", ofNoTriangle, "of every surface", normalMapOfMap},
      {"light of radiosity", blackBeside, "it shines", light<radiosity, shining>},
      {"sky of radiosity", blackBeside, "it shines", sky<radiosity, shining>},
      {"only sky of radiosity", "it is black", "it shines", sky<radiosity, dark>},
  };
}

namespace {

constexpr PictureMethod traced = PictureMethod::PathTracing, gathered = PictureMethod::GlobalIllumination;

template <PictureMethod method>
Setting withMaterials(Presence presence, const Effort& effort, MaterialEdit edit) {
  Setting setting = pictureOf("cornell", method, effort);
  editMaterials(setting.scene, presence, edit);
  return setting;
}

void gloss(Material& m) {
  m.metallic = 1.0f;
  m.roughness = 0.5f;
}

void tintedGlass(Material& m) {
  glass(m);
  m.attenuationColor = glm::vec3(0.5f);
  m.attenuationDistance = 1.0f;
}

template <PictureMethod method, MaterialEdit edit>
Setting material(Presence presence, const Effort& effort) {
  return withMaterials<method>(presence, effort, edit);
}

Setting textureOfPicture(Presence presence, const Effort& effort) {
  Setting setting = pictureOf("cornell", traced, effort);
  giveTexture(setting.scene, presence, &Material::baseColorTexture, false);
  return setting;
}

template <PictureMethod method>
Setting lightOfPicture(Presence presence, const Effort& effort) {
  Setting setting = pictureOf("cornell", method, effort);
  addLight(setting.scene, presence);
  return setting;
}

template <PictureMethod method>
Setting skyOfPicture(Presence presence, const Effort& effort) {
  Setting setting = pictureOf("cornell", method, effort);
  setting.sky = skyOf(presence);
  return setting;
}

/// Returns a setting about emission of surfaces other than the lamp.
Setting emission(Presence presence, const Effort& effort) {
  return withMaterials<traced>(presence, effort, [](Material& m) { m.emission = glm::vec3(0.1f); });
}

/// Returns a setting without any light, or with a black one.
Setting onlyLightOfPicture(Presence presence, const Effort& effort) {
  Setting setting = lightOfPicture<gathered>(presence, effort);
  for (Material& m : setting.scene.materials) m.emission = glm::vec3(0.0f);
  return setting;
}

}  // namespace

std::vector<Row> pictureRows() {
  const char* all = "of every surface";
  const char* black = "it is black, the lamp shines";
  return {
      {"mirrors, path tracing", ofNoTriangle, all, material<traced, mirror>},
      {"glossy lobes, path tracing", ofNoTriangle, all, material<traced, gloss>},
      {"glass, path tracing", ofNoTriangle, all, material<traced, glass>},
      {"absorption, path tracing", ofNoTriangle, all, material<traced, tintedGlass>},
      {"translucency, path tracing", ofNoTriangle, all, material<traced, translucent>},
      {"texture, path tracing", ofNoTriangle, all, textureOfPicture},
      {"emission, path tracing", ofNoTriangle, all, emission},
      {"light, path tracing", black, "it shines", lightOfPicture<traced>},
      {"sky, path tracing", black, "it shines", skyOfPicture<traced>},
      {"mirrors, global illumination", ofNoTriangle, all, material<gathered, mirror>},
      {"glass, global illumination", ofNoTriangle, all, material<gathered, glass>},
      {"translucency, global illumination", ofNoTriangle, all, material<gathered, translucent>},
      {"light, global illumination", black, "it shines", lightOfPicture<gathered>},
      {"sky, global illumination", black, "it shines", skyOfPicture<gathered>},
      {"only light, global illumination", "it is black", "it shines", onlyLightOfPicture},
  };
}

std::vector<Row> rows() {
  std::vector<Row> all = transferRows();
  for (const Row& row : staticLightRows()) all.push_back(row);
  for (const Row& row : pictureRows()) all.push_back(row);
  return all;
}

}  // namespace prelight::benchmarks::skip
