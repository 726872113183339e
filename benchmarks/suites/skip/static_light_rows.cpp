#include "benchmarks/suites/skip/edits.h"
#include "benchmarks/suites/skip/rows.h"

namespace prelight::benchmarks::skip {

namespace {

/// Whether a setting has the lights of its scene.
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

}  // namespace prelight::benchmarks::skip
