#include "gpu/scene_albedos.h"

#include <map>

#include "gpu/albedo_table.h"
#include "gpu/anisotropic_table.h"
#include "gpu/film_table.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

/// Its place in the table.
std::uint32_t appendTable(const std::vector<glm::vec4>& more, std::vector<glm::vec4>& table) {
  const auto first = static_cast<std::uint32_t>(table.size());
  table.insert(table.end(), more.begin(), more.end());
  return first;
}

}  // namespace

SceneAlbedos makeSceneAlbedos(const CompiledScene& scene, const std::vector<bool>& used,
                              GlassTables glassTables) {
  const std::size_t count = scene.materials.size();
  bool sheen = false, anisotropic = false;
  for (std::size_t i = 0; i < count; ++i) {
    sheen = sheen || (used[i] && hasSheen(scene.materials[i]));
    anisotropic = anisotropic || (used[i] && isAnisotropic(scene.materials[i]));
  }
  SceneAlbedos albedos{makeAlbedoTable(sheen), std::vector<std::uint32_t>(count, 0),
                       std::vector<std::uint32_t>(count, 0)};
  if (anisotropic) appendTable(makeAnisotropicTable(), albedos.texels);
  std::map<float, std::uint32_t> glass;  // by index of refraction
  for (std::size_t i = 0; i < count; ++i) {
    const CompiledMaterial& m = scene.materials[i];
    if (used[i] && hasFilm(m)) albedos.filmTables[i] = appendTable(makeFilmTable(m), albedos.texels);
    if (glassTables == GlassTables::None || !used[i] || !m.solid || !isRoughGlass(m)) continue;
    const auto [table, isNew] = glass.try_emplace(m.ior, static_cast<std::uint32_t>(albedos.texels.size()));
    if (isNew) appendTable(makeGlassTable(static_cast<double>(m.ior)), albedos.texels);
    albedos.glassTables[i] = table->second;
  }
  return albedos;
}

}  // namespace prelight
