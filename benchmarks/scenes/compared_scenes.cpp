#include "benchmarks/scenes/compared_scenes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/builtin.h"
#include "scene/builtin/gltf_builder.h"
#include "scene/builtin/mesh_shapes.h"
#include "scene/gltf/load/loader.h"
#include "viewer/options/light_option.h"

namespace prelight::benchmarks {

namespace {

using std::numbers::pi;
constexpr double goldenAngle = pi * (3.0 - 2.23606797749979);

ComparedScene loaded(const std::string& name, GltfDocument&& document) {
  ComparedScene result;
  result.document = std::move(document);
  Warnings warnings;
  result.scene.name = name;
  result.scene.scene = loadScene(result.document, warnings);
  result.scene.compiled = compileScene(result.scene.scene, warnings);
  return result;
}

/// Turns a diffuse material of a document into a metal of this roughness.
void makeMetal(GltfDocument& document, int material, double roughness) {
  auto& json = document.json["materials"][static_cast<std::size_t>(material)];
  json["pbrMetallicRoughness"]["metallicFactor"] = 1;
  json["pbrMetallicRoughness"]["roughnessFactor"] = roughness;
}

/// Gives a diffuse material a reflecting coat of refractive index 1.8 (8 % along the normal).
void polish(GltfDocument& document, int material, double roughness) {
  auto& json = document.json["materials"][static_cast<std::size_t>(material)];
  json["pbrMetallicRoughness"]["roughnessFactor"] = roughness;
  json["extensions"]["KHR_materials_specular"]["specularFactor"] = 1;
  json["extensions"]["KHR_materials_ior"]["ior"] = 1.8;
  auto& used = document.json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), "KHR_materials_ior") == used.end())
    used.push_back("KHR_materials_ior");
}

/// Returns one of five shapes, about 1.4 m wide.
MeshShape shapeOf(int kind) {
  switch (kind % 5) {
    case 0:
      return makeSphere(0.7f, 36, 26);
    case 1:
      return makeTorus(0.55f, 0.22f, 42, 22);
    case 2:
      return makeBox({1.1, 1.3, 0.9}, 11, true);
    case 3:
      return makeCone(0.6f, 1.7f, 40, 16, 6);
    default:
      return makeCylinder(0.45f, 1.5f, 40, 16, 6);
  }
}

/// Returns a colour of the colour circle; all have the same lightness.
glm::vec3 hue(double turn) {
  const auto channel = [&](double shift) {
    return static_cast<float>(0.42 + 0.36 * std::cos(2.0 * pi * (turn - shift)));
  };
  return {channel(0.0), channel(1.0 / 3.0), channel(2.0 / 3.0)};
}

/// Adds an object at the place of a seed in a sunflower: evenly spaced, in no rows. Returns its material.
int addCrowdObject(int number, GltfBuilder& builder) {
  constexpr double lift = 0.01;  // keeps faces out of the ground's plane
  constexpr double spacing = 1.35;
  const double radius = spacing * std::sqrt(number + 0.3), angle = goldenAngle * number;
  const int material = builder.addDiffuse(fmt::format("Colour {}", number), hue(0.381966 * number));
  builder.addObject(fmt::format("Object {}", number), shapeOf(number * 3 + number / 5), material,
                    glm::vec3(radius * std::cos(angle), lift, radius * std::sin(angle)), 1.7 * number);
  return material;
}

GltfDocument crowdOf(int objects, int lights) {
  GltfBuilder builder("crowd");
  constexpr double half = 8.0;
  constexpr int metalEvery = 6;
  std::vector<int> metals;
  builder.addObject("Ground",
                    makeGrid({-half, 0.0, half}, {2 * half, 0.0, 0.0}, {0.0, 0.0, -2 * half}, 48, 48),
                    builder.addDiffuse("Ground", {0.7f, 0.7f, 0.7f}));
  for (int i = 0; i < objects; ++i) {
    const int material = addCrowdObject(i, builder);
    if (i % metalEvery == metalEvery - 1) metals.push_back(material);
  }
  for (int i = 0; i < lights; ++i) {
    const double radius = 7.5 * std::sqrt((i + 0.5) / lights), angle = goldenAngle * i + 1.0;
    const glm::vec3 color = glm::mix(glm::vec3(1.0f), hue(i / static_cast<double>(lights)), 0.5f);
    builder.addPointLight(
        fmt::format("Light {}", i),
        glm::vec3(radius * std::cos(angle), 3.5 + 0.15 * ((7 * i) % 10), radius * std::sin(angle)), color,
        160.0 / lights);
  }
  builder.addCamera("Camera", {0.0, 7.6, 11.5}, {0.0, 0.2, 0.6}, 0.6, 16.0 / 9.0);
  GltfDocument document = builder.take();
  for (const int material : metals) makeMetal(document, material, 0.3);
  return document;
}

}  // namespace

std::string ComparedScene::light() const {
  if (sky) return "a sky";
  if (!lamps.empty()) return fmt::format("{} area lights", lamps.size());
  const std::size_t count = scene.compiled.lights.size();
  if (count == 0) return "a lamp of its own";
  return fmt::format("{} light{}", count, count == 1 ? "" : "s");
}

ComparedScene makeShapes() { return loaded("shapes", makeBuiltinScene("shapes")); }

ComparedScene makeShinyShapes() {
  GltfDocument document = makeBuiltinScene("shapes");
  const auto& materials = document.json["materials"];
  for (int m = 0; m < static_cast<int>(materials.size()); ++m) {
    const std::string name = materials[static_cast<std::size_t>(m)]["name"];
    if (name == "Ground") polish(document, m, 0.3);
    if (name == "Red" || name == "Yellow") makeMetal(document, m, 0.3);
  }
  return loaded("shiny shapes", std::move(document));
}

ComparedScene makeCrowd(int objects, int lights) { return loaded("crowd", crowdOf(objects, lights)); }

ComparedScene makeCrowdUnder(const Environment& sky, int objects) {
  ComparedScene result = loaded("crowd under a sky", crowdOf(objects, 0));
  result.sky = sky;
  return result;
}

ComparedScene makeCrowdWithObject(const Environment& sky, int objects) {
  ComparedScene result = loaded("crowd with an object put in", crowdOf(objects, 0));
  GltfBuilder alone("object");
  addCrowdObject(objects - 1, alone);
  result.put =
      PutObject{loaded("crowd", crowdOf(objects - 1, 0)).scene, loaded("object", alone.take()).scene};
  result.sky = sky;
  return result;
}

ComparedScene makeRoom() { return loaded("cornell", makeBuiltinScene("cornell")); }

ComparedScene makeRoomsByAreaLights() {
  ComparedScene result = loaded("rooms by area lights", makeBuiltinScene("rooms"));
  for (const char* lamp :
       {"area:quad:3.9,1.4,-0.4:-1,0,0:1,0.7:12,11,9", "area:sphere:-1.9,1.8,0.4:0.3:14,14,16"})
    result.lamps.push_back(viewer::parseLight(lamp));
  return result;
}

Environment makeEveningSky(int rows) {
  Environment sky{2 * rows, rows, {}};
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.6, 0.45, 0.5));
  const double edge = std::cos(5.0 * pi / 180.0);
  for (int y = 0; y < sky.height; ++y)
    for (int x = 0; x < sky.width; ++x) {
      const glm::dvec3 way = Environment::direction((x + 0.5) / sky.width, (y + 0.5) / sky.height);
      const double height = std::max(way.y, 0.0), facing = glm::dot(way, sun);
      const glm::dvec3 blue =
          glm::mix(glm::dvec3(0.9, 0.75, 0.6), glm::dvec3(0.2, 0.38, 0.75), std::pow(height, 0.4));
      const glm::dvec3 glow = 1.5 * std::pow(std::max(facing, 0.0), 24.0) * glm::dvec3(1.0, 0.75, 0.45);
      const double disc = glm::smoothstep(edge - 0.0005, edge + 0.0005, facing);
      const glm::dvec3 above = 0.8 * blue + glow + 90.0 * disc * glm::dvec3(1.0, 0.85, 0.65);
      const double isAbove = glm::smoothstep(-0.02, 0.02, way.y);
      sky.radiance.emplace_back(glm::mix(glm::dvec3(0.12, 0.11, 0.1), above, isAbove));
    }
  return sky;
}

}  // namespace prelight::benchmarks
