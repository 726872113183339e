#include "benchmarks/suites/skip/edits.h"
#include "benchmarks/suites/skip/rows.h"

namespace prelight::benchmarks::skip {

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

/// Emission of every surface but the lamp.
Setting emission(Presence presence, const Effort& effort) {
  return withMaterials<traced>(presence, effort, [](Material& m) { m.emission = glm::vec3(0.1f); });
}

/// No light at all, or one that is black.
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
