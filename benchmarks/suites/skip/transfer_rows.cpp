#include "benchmarks/suites/skip/rows.h"

namespace prelight::benchmarks::skip {

namespace {

Setting bouncingOf(const std::string& scene, const Effort& effort) {
  Setting setting = transferOf(scene, effort);
  setting.bake.bounces = 1;
  return setting;
}

Setting bounces(Presence presence, const Effort& effort) {
  Setting setting = transferOf("cornell", effort);
  setting.bake.bounces = presence == Presence::Absent ? 0 : 1;
  if (presence == Presence::Unneeded) blacken(setting.scene);
  return setting;
}

void wantCh(BakeRequest& request) { request.ch.order = 3; }
void wantHaar(BakeRequest& request) { request.haar.size = 4; }
void wantGlossy(BakeRequest& request) { request.glossy.order = 2; }
void wantVolume(BakeRequest& request) { request.volume.size = 4; }

template <void (*want)(BakeRequest&)>
Setting bouncesWith(Presence presence, const Effort& effort) {
  Setting setting = bounces(presence, effort);
  want(setting.bake);
  return setting;
}

/// Returns a setting about images, which no material has if not needed.
Setting images(Presence presence, const Effort& effort) {
  Setting setting = bouncingOf("cornell", effort);
  if (presence == Presence::Unneeded) addTexture(setting.scene, false);
  if (presence == Presence::Needed) giveTexture(setting.scene, presence, &Material::baseColorTexture, false);
  return setting;
}

/// Returns a setting about a second box, whose mesh no node has if not needed.
Setting meshes(Presence presence, const Effort& effort) {
  Setting setting = bouncingOf("cornell", effort);
  if (presence == Presence::Absent) return setting;
  const MeshNode last = setting.scene.meshNodes.back();
  setting.scene.meshes.push_back(setting.scene.meshes[static_cast<std::size_t>(last.mesh)]);
  if (presence == Presence::Unneeded) return setting;
  MeshNode& drawn = setting.scene.meshNodes.back();
  drawn.mesh = static_cast<int>(setting.scene.meshes.size()) - 1;
  for (Primitive& primitive : setting.scene.meshes.back().primitives)
    for (glm::vec3& position : primitive.positions) position *= 0.5f;
  return setting;
}

Setting translucency(Presence presence, const Effort& effort) {
  Setting setting = bouncingOf("cornell", effort);
  editMaterials(setting.scene, presence, translucent);
  return setting;
}

Setting translucencyWithoutBounces(Presence presence, const Effort& effort) {
  Setting setting = transferOf("cornell", effort);
  setting.bake.bounces = presence == Presence::Needed ? 1 : 0;
  if (presence != Presence::Absent) editMaterials(setting.scene, Presence::Needed, translucent);
  return setting;
}

void mask(Material& m) { m.alphaMode = AlphaMode::Mask; }

/// Returns a setting about alpha masks. A mask without holes is not needed; in the other, every second texel
/// is a hole.
Setting alphaWithoutHoles(Presence presence, const Effort& effort) {
  Setting setting = transferOf("cornell", effort);
  if (presence == Presence::Absent) return setting;
  const int image = addTexture(setting.scene, false);
  for (Material& m : setting.scene.materials) {
    mask(m);
    m.baseColorTexture.image = image;
  }
  if (presence == Presence::Needed) {
    std::vector<std::uint8_t>& rgba = setting.scene.images.back().rgba;
    for (std::size_t i = 3; i < rgba.size(); i += 8) rgba[i] = 0;
  }
  return setting;
}

Setting texture(Presence presence, const Effort& effort) {
  Setting setting = bouncingOf("cornell", effort);
  giveTexture(setting.scene, presence, &Material::baseColorTexture, false);
  return setting;
}

Setting textureWithoutBounces(Presence presence, const Effort& effort) {
  Setting setting = transferOf("cornell", effort);
  setting.bake.bounces = presence == Presence::Needed ? 1 : 0;
  if (presence != Presence::Absent)
    giveTexture(setting.scene, Presence::Needed, &Material::baseColorTexture, false);
  return setting;
}

Setting vertexColors(Presence presence, const Effort& effort) {
  Setting setting = bouncingOf("cornell", effort);
  if (presence == Presence::Absent) return setting;
  const glm::vec4 color = presence == Presence::Needed ? glm::vec4(0.5f, 0.8f, 0.3f, 1.0f) : glm::vec4(1.0f);
  for (Mesh& mesh : setting.scene.meshes)
    for (Primitive& primitive : mesh.primitives) primitive.colors.assign(primitive.positions.size(), color);
  return setting;
}

Setting shadowSets(Presence presence, const Effort& effort) {
  Setting setting = transferOf("cornell", effort);
  if (presence == Presence::Unneeded) setting.bake.shadowSets = {{{"*"}, {"*"}}};
  if (presence == Presence::Needed) setting.bake.shadowSets = {{{"Floor"}, {"*box", "Floor"}}};
  return setting;
}

Setting farLimit(Presence presence, const Effort& effort) {
  Setting setting = transferOf("cornell", effort);
  if (presence != Presence::Absent)
    setting.bake.limits.farthest = presence == Presence::Needed ? 0.5 : 1000.0;
  return setting;
}

Setting occludersOf(const Effort& effort) {
  Setting setting = transferOf("cornell", effort);
  setting.bake.occluders.wanted = true;
  return setting;
}

template <MaterialEdit edit>
Setting materialOfOccluders(Presence presence, const Effort& effort) {
  Setting setting = occludersOf(effort);
  editMaterials(setting.scene, presence, edit);
  return setting;
}

/// Returns a setting that requests specular transport, with and without glass.
Setting specularTransport(Presence presence, const Effort& effort) {
  Setting setting = bouncingOf("cornell", effort);
  setting.bake.specular = true;
  editMaterials(setting.scene, presence, glass);
  return setting;
}

/// Returns a setting with light groups and an added light. A light without power must not cost a group.
Setting lightOfGroups(Presence presence, const Effort& effort) {
  Setting setting = transferOf("cornell", effort);
  setting.bake.lightGroups.wanted = true;
  addLight(setting.scene, presence);
  return setting;
}

/// Returns a setting whose scene has as many unused vertices as used ones.
Setting looseVertices(Presence presence, const Effort& effort) {
  Setting setting = bouncingOf("cornell", effort);
  if (presence == Presence::Absent) return setting;
  for (Mesh& mesh : setting.scene.meshes)
    for (Primitive& primitive : mesh.primitives) {
      const auto first = static_cast<std::uint32_t>(primitive.positions.size());
      const auto twice = [](auto& values) {
        const auto once = values;
        values.insert(values.end(), once.begin(), once.end());
      };
      twice(primitive.positions);
      twice(primitive.normals);
      twice(primitive.tangents);
      twice(primitive.texCoords0);
      twice(primitive.texCoords1);
      if (presence == Presence::Needed)
        for (std::size_t t = 0; t < primitive.triangles.size(); t += 2) primitive.triangles[t] += first;
    }
  return setting;
}

}  // namespace

std::vector<Row> transferRows() {
  const char *black = "every surface is black", *asTheyAre = "surfaces as they are";
  return {
      {"bounces", black, asTheyAre, bounces},
      {"bounces, CH", black, asTheyAre, bouncesWith<wantCh>},
      {"bounces, Haar wavelets", black, asTheyAre, bouncesWith<wantHaar>},
      {"bounces, glossy transfer", black, asTheyAre, bouncesWith<wantGlossy>},
      {"bounces, volume", black, asTheyAre, bouncesWith<wantVolume>},
      {"images", "no material has them", "of every surface", images},
      {"meshes", "no node has them", "drawn in place of another", meshes},
      {"translucency", ofNoTriangle, "of every surface", translucency},
      {"translucency, no bounces", "of every surface, which only bounces come through", "with a bounce",
       translucencyWithoutBounces},
      {"holes of an alpha mask", "of every surface, each texel opaque", "half of the texels are holes",
       alphaWithoutHoles},
      {"base-colour texture", ofNoTriangle, "of every surface", texture},
      {"base-colour texture, no bounces", "of every surface, which only bounces read", "with a bounce",
       textureWithoutBounces},
      {"vertex colours", "all white", "coloured", vertexColors},
      {"shadow sets", "every node sees every other", "the floor sees two boxes", shadowSets},
      {"occlusion distance", "1000 m, farther than anything", "0.5 m", farLimit},
      {"glass seen by vector occluders", ofNoTriangle, "of every surface", materialOfOccluders<glass>},
      {"shine seen by vector occluders", ofNoTriangle, "of every surface", materialOfOccluders<mirror>},
      {"specular transport", ofNoTriangle, "glass, of every surface", specularTransport},
      {"light of a group", "it is black", "it shines", lightOfGroups},
      {"vertices of no triangle", "as many again", "triangles have them", looseVertices},
  };
}

}  // namespace prelight::benchmarks::skip
