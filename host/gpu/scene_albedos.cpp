#include "gpu/scene_albedos.h"

#include <algorithm>
#include <utility>

#include "gpu/albedo_table.h"
#include "gpu/anisotropic_table.h"
#include "gpu/film_table.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

/// Appends a table and returns where it begins.
std::uint32_t appendTable(const std::vector<glm::vec4>& more, std::vector<glm::vec4>& table) {
  const auto first = static_cast<std::uint32_t>(table.size());
  table.insert(table.end(), more.begin(), more.end());
  return first;
}

/// Returns the glass of a material without its textures.
GlassSurface glassSurfaceOf(const CompiledMaterial& m) {
  GlassSurface surface = glassOfIor(double(m.ior));
  surface.f90 = double(m.specular);
  surface.f0 = surface.f90 * glm::min(surface.f0 * glm::dvec3(m.specularColor), glm::dvec3(1.0));
  if (!hasFilm(m)) return surface;
  surface.filmShare = double(m.iridescence.factor);
  surface.filmOutside = 1.0 + 0.5 * double(m.clearcoat.factor);
  surface.filmIor = double(m.iridescence.ior);
  surface.filmThickness = double(m.iridescence.thicknessMaximum);
  return surface;
}

}  // namespace

SceneAlbedos makeSceneAlbedos(const CompiledScene& scene, const std::vector<bool>& used) {
  const std::size_t count = scene.materials.size();
  bool sheen = false, anisotropic = false;
  for (std::size_t i = 0; i < count; ++i) {
    sheen = sheen || (used[i] && hasSheen(scene.materials[i]));
    anisotropic = anisotropic || (used[i] && isAnisotropic(scene.materials[i]));
  }
  SceneAlbedos albedos{makeAlbedoTable(sheen), std::vector<std::uint32_t>(count, 0),
                       std::vector<std::uint32_t>(count, 0)};
  if (anisotropic) appendTable(makeAnisotropicTable(), albedos.texels);
  std::vector<std::pair<GlassSurface, std::uint32_t>> glass;  // equal surfaces share a table
  for (std::size_t i = 0; i < count; ++i) {
    const CompiledMaterial& m = scene.materials[i];
    if (used[i] && hasFilm(m) && reflectsSpecularly(m))
      albedos.filmTables[i] = appendTable(makeFilmTable(m), albedos.texels);
    if (!used[i] || !m.solid || !isRoughGlass(m)) continue;
    const GlassSurface surface = glassSurfaceOf(m);
    auto known = std::find_if(glass.begin(), glass.end(), [&](const auto& g) { return g.first == surface; });
    if (known == glass.end())
      known = glass.insert(known, {surface, appendTable(makeGlassTable(surface), albedos.texels)});
    albedos.glassTables[i] = known->second;
  }
  return albedos;
}

}  // namespace prelight
