#include "viewer/quad_scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include "basis/sh.h"

namespace prelight::test {

Material lambertian(const glm::vec3& albedo) {
  Material material;
  material.baseColor = glm::vec4(albedo, 1.0f);
  material.metallic = 0.0f;
  material.specular = 0.0f;
  return material;
}

Light makeLight(LightType type, const glm::vec3& intensity, const glm::dvec3& position,
                const glm::dvec3& direction) {
  Light light;
  light.type = type;
  light.intensity = intensity;
  light.position = position;
  light.direction = glm::normalize(direction);
  return light;
}

Primitive& QuadScene::add(const Material& material, float half, const glm::dmat4& transform) {
  Primitive quad;
  quad.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  quad.normals.assign(4, {0, 0, 1});
  quad.texCoords0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  quad.triangles = {{0, 1, 2}, {0, 2, 3}};
  quad.material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(material);
  const int index = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back({"quad", {std::move(quad)}});
  scene.meshNodes.push_back({index, "quad", index, {transform}});
  return scene.meshes.back().primitives.front();
}

void QuadScene::lookFrom(const glm::dvec3& eye, const glm::dvec3& target) {
  Camera camera;
  const glm::dvec3 forward = glm::normalize(target - eye);
  const glm::dvec3 up = std::abs(forward.y) > 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  camera.world = glm::inverse(glm::lookAtRH(eye, target, up));
  scene.cameras.push_back(camera);
}

void QuadScene::setSky(const Environment& sky) {
  environment = sky;
  hasEnvironment = true;
}

void QuadScene::compile() {
  Warnings warnings;
  compiled = compileScene(scene, warnings);
}

void QuadScene::bakeOpen(int order, int channels, float accessibility, double openness) {
  bake.ao.assign(compiled.vertexCount(), accessibility);
  bake.bentNormals = compiled.normals;
  HarmonicTransfer sh{order, channels, 0, {}};
  std::vector<double> transfer(sh::coefficientCount(order));
  for (const glm::vec3& normal : compiled.normals) {
    sh::openTransfer(glm::dvec3(normal), order, transfer);
    for (int c = 0; c < channels; ++c) {
      for (const double value : transfer) sh.coefficients.push_back(static_cast<float>(openness * value));
    }
  }
  bake.sh = std::move(sh);
}

viewer::RenderInputs QuadScene::inputs() const {
  return {scene, compiled, &bake, hasEnvironment ? &environment : nullptr};
}

Picture QuadScene::render(const viewer::RenderOptions& options) const {
  Warnings notes;
  return viewer::renderPicture(inputs(), options, notes);
}

viewer::RenderOptions square(viewer::Shading shading, int size) {
  viewer::RenderOptions options;
  options.shading = shading;
  options.width = size;
  options.height = size;
  return options;
}

viewer::RenderOptions squareByBake(viewer::Shading shading, int size) {
  viewer::RenderOptions options = square(shading, size);
  options.direct = LampShadows::Baked;
  return options;
}

glm::vec3 pixelAt(const Picture& picture, double x, double y) {
  const auto column = static_cast<std::size_t>(x * picture.width);
  const auto row = static_cast<std::size_t>(y * picture.height);
  return picture.pixels[row * static_cast<std::size_t>(picture.width) + column];
}

Environment halvedSky() {
  Environment sky{128, 64, {}};
  for (int row = 0; row < sky.height; ++row) {
    for (int column = 0; column < sky.width; ++column) {
      const glm::dvec3 w = Environment::direction((column + 0.5) / sky.width, (row + 0.5) / sky.height);
      sky.radiance.emplace_back(w.x > 0.0 ? 1.0f : 0.0f, w.x < 0.0 ? 1.0f : 0.0f, w.y > 0.0 ? 1.0f : 0.0f);
    }
  }
  return sky;
}

}  // namespace prelight::test
