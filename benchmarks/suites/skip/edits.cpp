#include "benchmarks/suites/skip/rows.h"

#include <array>
#include <cstddef>

#include "prelight/error.h"
#include "prelight/load.h"

namespace prelight::benchmarks::skip {

namespace {

Setting settingOf(const std::string& scene, const Effort& effort) {
  Setting setting;
  setting.scene = builtin(scene);
  setting.bake.effort.rays = effort.rays;
  return setting;
}

/// Adds texture coordinates to primitives without them, with at least two texels per metre.
void addTexCoords(Scene& scene) {
  for (Mesh& mesh : scene.meshes)
    for (Primitive& primitive : mesh.primitives)
      if (primitive.texCoords0.empty())
        for (const glm::vec3& p : primitive.positions)
          primitive.texCoords0.emplace_back(p.x + 0.37f * p.z, p.y + 0.61f * p.z);
}

}  // namespace

Scene builtin(const std::string& name) { return loadBuiltin(name).scene; }

Setting transferOf(const std::string& scene, const Effort& effort) {
  Setting setting = settingOf(scene, effort);
  setting.bake.ao = true;
  setting.bake.sh.order = 3;
  return setting;
}

Setting lightMapOf(const std::string& scene, const Effort& effort) {
  Setting setting = settingOf(scene, effort);
  setting.bake.lightMap.wanted = true;
  setting.bake.lightMap.texelSize = effort.texelSize;
  setting.bake.lightMap.photons = effort.photons;
  return setting;
}

Setting radiosityOf(const std::string& scene, const Effort& effort) {
  Setting setting = settingOf(scene, effort);
  setting.bake.radiosity.wanted = true;
  setting.bake.radiosity.patchSize = effort.patchSize;
  return setting;
}

Setting pictureOf(const std::string& scene, PictureMethod method, const Effort& effort) {
  Setting setting = settingOf(scene, effort);
  setting.picture = PictureWork{method, effort.side, effort.samples};
  return setting;
}

void editMaterials(Scene& scene, Presence presence, MaterialEdit edit) {
  if (presence == Presence::Absent) return;
  if (presence == Presence::Unneeded) {
    scene.materials.emplace_back().name = "Of no triangle";
    edit(scene.materials.back());
    return;
  }
  for (Material& material : scene.materials)
    if (!material.isEmissive()) edit(material);
}

void mirror(Material& material) {
  material.metallic = 1.0f;
  material.roughness = 0.0f;
}

void glass(Material& material) {
  material.transmission = 1.0f;
  material.thickness = 1.0f;
  material.roughness = 0.0f;
}

void translucent(Material& material) { material.diffuseTransmission = 0.5f; }

int addTexture(Scene& scene, bool flat) {
  constexpr int side = 4;
  constexpr std::array<std::array<std::uint8_t, 4>, 2> colors = {{{230, 120, 60, 255}, {60, 120, 230, 255}}};
  Image image{"Checks", side, side, {}};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto& color = colors[flat ? 0 : static_cast<std::size_t>((x + y) % 2)];
      image.rgba.insert(image.rgba.end(), color.begin(), color.end());
    }
  scene.images.push_back(std::move(image));
  addTexCoords(scene);
  return static_cast<int>(scene.images.size()) - 1;
}

void giveTexture(Scene& scene, Presence presence, TextureRef Material::*texture, bool flat) {
  if (presence == Presence::Absent) return;
  const int image = addTexture(scene, flat);
  if (presence == Presence::Unneeded) {
    (scene.materials.emplace_back().*texture).image = image;
    return;
  }
  for (Material& material : scene.materials) (material.*texture).image = image;
}

void addLight(Scene& scene, Presence presence) {
  if (presence == Presence::Absent) return;
  Light light;
  light.name = "Added light";
  light.intensity = glm::vec3(presence == Presence::Needed ? 1.0f : 0.0f);
  light.position = {0.0, 1.7, 0.5};
  scene.lights.push_back(light);
}

void takeLightsAway(Scene& scene) {
  scene.lights.clear();
  for (Material& material : scene.materials) material.emission = glm::vec3(0.0f);
}

void blacken(Scene& scene) {
  for (Material& material : scene.materials) material.baseColor = {0.0f, 0.0f, 0.0f, material.baseColor.a};
}

std::shared_ptr<const Environment> skyOf(Presence presence) {
  if (presence == Presence::Absent) return nullptr;
  const float radiance = presence == Presence::Needed ? 1.0f : 0.0f;
  return std::make_shared<const Environment>(constantEnvironment(glm::vec3(radiance)));
}

}  // namespace prelight::benchmarks::skip
