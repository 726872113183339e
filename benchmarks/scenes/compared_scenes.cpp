#include "benchmarks/scenes/compared_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/builtin/builtin.h"
#include "scene/builtin/crowd_scene.h"
#include "scene/builtin/gltf_builder.h"
#include "scene/gltf/load/loader.h"
#include "viewer/options/light_option.h"

namespace prelight::benchmarks {

namespace {

ComparedScene loaded(const std::string& name, GltfDocument&& document) {
  ComparedScene result;
  result.document = std::move(document);
  Warnings warnings;
  result.scene.name = name;
  result.scene.scene = loadScene(result.document, warnings);
  result.scene.compiled = compileScene(result.scene.scene, warnings);
  return result;
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

ComparedScene makeShinyShapes() { return loaded("shiny shapes", makeBuiltinScene("shiny")); }

ComparedScene makeCrowd(int objects, int lights) { return loaded("crowd", makeCrowdScene(objects, lights)); }

ComparedScene makeCrowdUnder(const Environment& sky, int objects) {
  ComparedScene result = loaded("crowd under a sky", makeCrowdScene(objects, 0));
  result.sky = sky;
  return result;
}

ComparedScene makeCrowdWithObject(const Environment& sky, int objects) {
  ComparedScene result = loaded("crowd with an object put in", makeCrowdScene(objects, 0));
  GltfBuilder alone("object");
  addCrowdObject(objects - 1, false, alone);
  result.put =
      PutObject{loaded("crowd", makeCrowdScene(objects - 1, 0)).scene, loaded("object", alone.take()).scene};
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
  const double edge = std::cos(5.0 * std::numbers::pi / 180.0);
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
