#include "support/screen_scene.h"

#include <random>

namespace prelight::test {

namespace {

void addMesh(Scene& scene, Primitive primitive, const char* name) {
  MeshNode node;
  node.mesh = static_cast<int>(scene.meshes.size());
  node.node = static_cast<int>(scene.nodes.size());
  node.transforms = {glm::dmat4(1.0)};
  scene.meshes.push_back({name, {std::move(primitive)}});
  scene.nodes.emplace_back();
  scene.meshNodes.push_back(node);
}

/// A quad from `corner` along two edges; its front is on the side of their cross product.
Primitive quad(const glm::vec3& corner, const glm::vec3& along, const glm::vec3& across, float least,
               float most) {
  Primitive primitive;
  primitive.positions = {corner, corner + along, corner + along + across, corner + across};
  primitive.texCoords0 = {{least, least}, {most, least}, {most, most}, {least, most}};
  primitive.triangles = {{0, 1, 2}, {0, 2, 3}};
  primitive.material = 0;
  return primitive;
}

Material glowing() {
  Material material;
  material.metallic = 0.0f;
  material.specular = 0.0f;
  material.emission = glm::vec3(screenRadiance);
  return material;
}

}  // namespace

Scene screenScene(const Image& image) {
  Scene scene;
  scene.materials.push_back(glowing());
  scene.materials[0].baseColor = {0, 0, 0, 1};
  if (!image.rgba.empty()) {
    scene.images = {image};
    scene.materials[0].emissiveTexture.image = 0;
  }
  addMesh(scene, quad({-1, 2, -0.5f}, {2, 0, 0}, {0, 0, 1}, 0.0f, 1.0f), "screen");
  return scene;
}

Scene atlasScene() {
  Scene scene;
  Image atlas{"atlas", 64, 64, std::vector<std::uint8_t>(4 * 64 * 64, 0)};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 4; ++c)
        atlas.rgba[static_cast<std::size_t>(4 * (64 * y + x) + c)] = c == 3 || (x < 16 && y < 16) ? 255 : 0;
  scene.images = {atlas};
  scene.materials.push_back(glowing());
  scene.materials[0].baseColor = glm::vec4(glm::vec3(0.7f), 1.0f);
  scene.materials[0].emissiveTexture.image = 0;
  const glm::vec3 x(4, 0, 0), y(0, 3, 0), z(0, 0, 4), low(-2, 0, -2), high(2, 3, 2);
  for (const Primitive& wall :
       {quad(low, z, x, 0.5f, 0.95f), quad(low, x, y, 0.5f, 0.95f), quad(low, y, z, 0.5f, 0.95f),
        quad(high, -x, -z, 0.5f, 0.95f), quad(high, -y, -x, 0.5f, 0.95f), quad(high, -z, -y, 0.5f, 0.95f)})
    addMesh(scene, wall, "wall");
  addMesh(scene, quad({-0.5f, 2.9f, -0.5f}, {1, 0, 0}, {0, 0, 1}, 0.02f, 0.22f), "lamp");
  return scene;
}

Image leftQuarter(int width, int height) {
  Image image{"left quarter", width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    const std::uint8_t value = i % width < width / 4 ? 255 : 0;
    image.rgba.insert(image.rgba.end(), {value, value, value, 255});
  }
  return image;
}

Image noiseImage(int width, int height) {
  std::mt19937 random(1);
  Image image{"noise", width, height, {}};
  for (int i = 0; i < 4 * width * height; ++i)
    image.rgba.push_back(i % 4 == 3 ? 255 : static_cast<std::uint8_t>(random() & 255u));
  return image;
}

CompiledScene compiledOf(const Scene& scene) {
  Warnings warnings;
  return compileScene(scene, warnings);
}

}  // namespace prelight::test
