#include "benchmarks/scenes/bending_column.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "scene/pose.h"

namespace prelight::benchmarks {

namespace {

constexpr double height = 2.0;  // m
constexpr int joints = 5, around = 32, rings = 48, cells = 48;

/// Adds the squares of a grid of vertices, [row][column].
void addGrid(int rows, int columns, Primitive& primitive) {
  const auto at = [&](int row, int column) {
    return static_cast<std::uint32_t>(row * (columns + 1) + column);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      primitive.triangles.emplace_back(at(row, column), at(row + 1, column), at(row, column + 1));
      primitive.triangles.emplace_back(at(row, column + 1), at(row + 1, column), at(row + 1, column + 1));
    }
}

Primitive ground() {
  Primitive primitive;
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) {
      const glm::dvec2 place = 4.0 * glm::dvec2(column, row) / double(cells) - 2.0;
      primitive.positions.emplace_back(place.x, 0.0, place.y);
      primitive.normals.emplace_back(0.0, 1.0, 0.0);
    }
  addGrid(cells, cells, primitive);
  return primitive;
}

/// Gives the last vertex the two joints next to its height, with weights that change smoothly.
void addInfluences(double share, Primitive& primitive) {
  const double place = share * (joints - 1);
  const int joint = std::min(static_cast<int>(place), joints - 2);
  const double t = place - joint, weight = t * t * (3.0 - 2.0 * t);
  for (const int j : {joint, joint + 1}) primitive.joints.push_back(static_cast<std::uint32_t>(j));
  for (const double w : {1.0 - weight, weight}) primitive.jointWeights.push_back(static_cast<float>(w));
}

Primitive column() {
  Primitive primitive;
  primitive.influences = 2;
  for (int ring = 0; ring <= rings; ++ring)
    for (int i = 0; i <= around; ++i) {
      const double share = double(ring) / rings, wave = 6.0 * std::numbers::pi * share;
      const double radius = 0.22 * (1.0 + 0.25 * std::sin(wave));
      const double slope = 0.22 * 0.25 * 6.0 * std::numbers::pi * std::cos(wave) / height;
      const double angle = 2.0 * std::numbers::pi * i / around;
      const glm::dvec3 out(std::cos(angle), 0.0, std::sin(angle));
      primitive.positions.emplace_back(radius * out + glm::dvec3(0.0, height * share, 0.0));
      primitive.normals.emplace_back(glm::normalize(out - glm::dvec3(0.0, slope, 0.0)));
      addInfluences(share, primitive);
    }
  addGrid(rings, around, primitive);
  return primitive;
}

void addNode(Scene& scene, Primitive primitive, const char* name, int skin) {
  primitive.material = 0;
  MeshNode node;
  node.mesh = static_cast<int>(scene.meshes.size());
  node.sceneNode = scene.nodes.size();
  node.node = static_cast<int>(node.sceneNode);
  node.name = name;
  node.skin = skin;
  node.transforms = {glm::dmat4(1.0)};
  scene.nodes.emplace_back().node = node.node;
  scene.meshes.push_back({name, {std::move(primitive)}});
  scene.meshNodes.push_back(node);
}

void addJoints(Scene& scene) {
  Skin skin;
  Animation animation{"bend", {}, {}};
  for (int j = 0; j < joints; ++j) {
    SceneNode& node = scene.nodes.emplace_back();
    node.node = static_cast<int>(scene.nodes.size()) - 1;
    node.parent = j == 0 ? -1 : node.node - 1;
    if (j > 0) node.translation = {0.0, height / (joints - 1), 0.0};
    skin.joints.push_back(scene.nodes.size() - 1);
    skin.inverseBind.push_back(
        glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -height * j / (joints - 1), 0.0)));
    if (j == 0) continue;
    AnimationSampler sampler{Interpolation::Linear, {0, 1, 2, 3}, {}};
    const glm::dvec3 axis = j % 2 == 1 ? glm::dvec3(0, 0, 1) : glm::normalize(glm::dvec3(0.7, 0, 0.5));
    for (const double degrees : {0.0, 28.0, -20.0, 0.0}) {
      const glm::dquat turn = glm::angleAxis(glm::radians(degrees), axis);
      sampler.values.emplace_back(turn.x, turn.y, turn.z, turn.w);
    }
    animation.channels.push_back({scene.nodes.size() - 1, AnimatedPath::Rotation, animation.samplers.size()});
    animation.samplers.push_back(sampler);
  }
  scene.skins.push_back(skin);
  scene.animations.push_back(animation);
}

}  // namespace

BenchmarkScene bendingColumn() {
  BenchmarkScene made;
  made.name = "column, bending";
  Material& matte = made.scene.materials.emplace_back();
  matte.baseColor = {0.6f, 0.6f, 0.6f, 1.0f};
  matte.metallic = matte.specular = 0.0f;
  addNode(made.scene, ground(), "Ground", -1);
  addNode(made.scene, column(), "Column", 0);
  addJoints(made.scene);
  setPose(made.scene, 0, 0.0);
  Warnings said;
  made.compiled = compileScene(made.scene, said);
  return made;
}

}  // namespace prelight::benchmarks
