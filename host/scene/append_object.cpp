#include "scene/append_object.h"

#include <algorithm>

namespace prelight {

namespace {

int freeNumber(const Scene& scene) {
  int number = 0;
  for (const SceneNode& node : scene.nodes) number = std::max(number, node.node + 1);
  for (const MeshNode& node : scene.meshNodes) number = std::max(number, node.node + 1);
  return number;
}

void shiftImages(Material& m, int by) {
  for (TextureRef* texture :
       {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.emissiveTexture, &m.normalTexture,
        &m.transmissionTexture, &m.specularTexture, &m.specularColorTexture, &m.diffuseTransmissionTexture,
        &m.diffuseTransmissionColorTexture, &m.clearcoat.texture, &m.clearcoat.roughnessTexture,
        &m.clearcoat.normalTexture, &m.sheen.colorTexture, &m.anisotropy.texture, &m.iridescence.texture,
        &m.iridescence.thicknessTexture})
    if (texture->image >= 0) texture->image += by;
}

void appendMaterials(Scene& scene, const Scene& object) {
  const auto images = static_cast<int>(scene.images.size());
  scene.images.insert(scene.images.end(), object.images.begin(), object.images.end());
  for (const Material& material : object.materials) {
    scene.materials.push_back(material);
    shiftImages(scene.materials.back(), images);
  }
}

void appendMeshes(Scene& scene, const Scene& object, int firstMaterial) {
  for (const Mesh& mesh : object.meshes) {
    scene.meshes.push_back(mesh);
    for (Primitive& primitive : scene.meshes.back().primitives)
      if (primitive.material >= 0) primitive.material += firstMaterial;
  }
}

/// Appends the object's nodes below a new node with the object's name and placement.
void appendNodes(Scene& scene, const Scene& object, int number, const glm::dmat4& place) {
  const auto root = static_cast<int>(scene.nodes.size());
  SceneNode placed;
  placed.node = number;
  placed.hasMatrix = true;
  placed.matrix = place;
  scene.nodes.push_back(placed);
  for (SceneNode node : object.nodes) {
    node.node += number + 1;
    node.parent = node.parent < 0 ? root : node.parent + root + 1;
    scene.nodes.push_back(node);
  }
}

}  // namespace

int appendObject(Scene& scene, const Scene& object, const std::string& name, const glm::dmat4& place) {
  const int number = freeNumber(scene), firstMesh = static_cast<int>(scene.meshes.size()),
            firstSkin = static_cast<int>(scene.skins.size());
  const std::size_t firstNode = scene.nodes.size() + 1;
  appendMeshes(scene, object, static_cast<int>(scene.materials.size()));
  appendMaterials(scene, object);
  appendNodes(scene, object, number, place);
  for (Skin skin : object.skins) {
    for (std::size_t& joint : skin.joints) joint += firstNode;
    scene.skins.push_back(std::move(skin));
  }
  for (MeshNode node : object.meshNodes) {
    node.node = number;
    node.name = name;
    node.mesh += firstMesh;
    node.sceneNode += firstNode;
    if (node.skin >= 0) node.skin += firstSkin;
    for (glm::dmat4& transform : node.transforms) transform = place * transform;
    scene.meshNodes.push_back(std::move(node));
  }
  return number;
}

}  // namespace prelight
