#include <algorithm>
#include <array>
#include <cmath>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "basis/sh_zonal.h"
#include "benchmarks/suites/stability/cases.h"
#include "benchmarks/suites/stability/shapes.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/loader.h"

// Whole bakes.
namespace prelight::benchmarks::stability {

namespace {

Bake bakeOf(const CompiledScene& scene, const BakeRequest& request, Trials& trials) {
  Progress progress;
  BakeReport report;
  return bakeScene(scene, request, makePlan(Scene(), scene, request), trials.device(), progress, report);
}

BakeRequest requestOf(std::uint64_t rays) {
  BakeRequest request;
  request.effort.rays = rays;
  return request;
}

/// An open floor has a closed form in every band.
void openFloor(const char* stress, double half, const glm::dvec3& offset, int order, Trials& trials) {
  const CompiledScene scene = floorScene(half, 1, matte(1.0), offset);
  BakeRequest request = requestOf(64);
  request.ao = true;
  request.sh.order = order;
  const Bake bake = bakeOf(scene, request, trials);
  std::vector<double> truth(static_cast<std::size_t>(order * order));
  sh::openTransfer({0, 1, 0}, order, truth);
  Differences differences;
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    differences.add(bake.ao[v], 1.0);
    for (std::size_t i = 0; i < truth.size(); ++i)
      differences.add(bake.sh->coefficients[v * truth.size() + i], truth[i], 1.0);
  }
  trials.record(stress, differences, 1e-6, {"order", double(order)});
}

/// Walls that emit, seen from walls: after B bounces the sum of the albedo's powers.
void bouncingRoom(const char* stress, double half, double albedo, double emission, int bounces,
                  Trials& trials) {
  const CompiledScene scene = roomScene(half, 2, matte(albedo, emission));
  BakeRequest request = requestOf(256);
  request.lightGroups.wanted = true;
  request.bounces = bounces;
  const Bake bake = bakeOf(scene, request, trials);
  double truth = 0.0, left = 1.0;
  for (int k = 0; k <= bounces; ++k) {
    truth += left;
    left *= std::round(albedo * 1023.0) / 1023.0;
  }
  double mean = 0.0;
  Differences differences;
  for (const float value : bake.lightGroups->coefficients) {
    differences.add(value, value);
    mean += double(value) / double(bake.lightGroups->coefficients.size());
  }
  differences.add(mean, truth);
  trials.record(stress, differences, 0.05, {"bounces", double(bounces)});
}

/// Lights of a group: irradiance over pi and the group's colour.
void litFloor(const char* stress, double half, const Light& light, double irradiance, Trials& trials) {
  CompiledScene scene = floorScene(half, 1, matte(1.0));
  scene.lights = {light};
  BakeRequest request = requestOf(64);
  request.lightGroups.wanted = true;
  const Bake bake = bakeOf(scene, request, trials);
  Differences differences;
  for (const float value : bake.lightGroups->coefficients)
    differences.add(value, irradiance / double(light.intensity.x) / pi);
  trials.record(stress, differences, 1e-5);
}

/// A closed room is dark, and what hides the sky adds up to all of it.
void closedRoom(const char* stress, double half, const glm::dvec3& offset, Trials& trials) {
  const CompiledScene scene = roomScene(half, 2, matte(0.5), offset);
  BakeRequest request = requestOf(128);
  request.ao = request.occluders.wanted = true;
  request.sh.order = 4;
  const Bake bake = bakeOf(scene, request, trials);
  Differences differences;
  for (const float ao : bake.ao) differences.add(ao, 0.0, 1.0);
  for (const float value : bake.sh->coefficients) differences.add(value, 0.0, 1.0);
  const OccluderTransfer& occluders = *bake.occluders;
  const auto occlusion = static_cast<std::size_t>(
      std::find(occluders.stored.begin(), occluders.stored.end(), OccluderVector::Occlusion) -
      occluders.stored.begin());
  for (std::size_t v = 0; v < scene.vertexCount(); ++v) {
    double sum = 0.0;
    for (std::uint32_t r = occluders.offsets[v]; r < occluders.offsets[v + 1]; ++r)
      sum += double(occluders.vectors[r * occluders.stored.size() + occlusion].w);
    differences.add(sum, 1.0);
  }
  // The bound is the vertex fit's, see there.
  trials.record(stress, differences, 1e-5 * std::sqrt(double(scene.vertexCount())));
}

template <typename Values>
void finite(const Values& values, Differences& differences) {
  for (const auto& value : values) differences.add(double(value), double(value));
}

/// A scene with everything baked, whatever its size and place: nothing but finite numbers, AO within its
/// range.
void everything(const std::string& name, double size, const glm::dvec3& offset, double albedo,
                Trials& trials) {
  Warnings warnings;
  GltfDocument document = makeBuiltinScene(name);
  Scene loaded = loadScene(document, warnings);
  glm::dmat4 place(1.0);
  for (int axis = 0; axis < 3; ++axis) place[axis] *= size;
  place[3] = {offset, 1.0};
  for (MeshNode& node : loaded.meshNodes)
    for (glm::dmat4& transform : node.transforms) transform = place * transform;
  for (Light& light : loaded.lights) light.position = glm::dvec3(place * glm::dvec4(light.position, 1.0));
  for (Material& material : loaded.materials)
    if (albedo >= 0.0) material.baseColor = glm::vec4(glm::vec3(static_cast<float>(albedo)), 1.0f);
  const CompiledScene scene = compileScene(loaded, warnings);
  BakeRequest request = requestOf(trials.options().bakeRays);
  request.ao = request.occluders.wanted = request.lightGroups.wanted = true;
  request.sh.order = request.ch.order = 4;
  request.haar.size = 8;
  request.glossy.order = 2;
  request.volume.size = 4;
  request.bounces = 2;
  const Bake bake = bakeOf(scene, request, trials);
  Differences differences;
  for (const float ao : bake.ao) differences.add(ao, std::clamp(double(ao), 0.0, 1.0), 1.0);
  for (const glm::vec3& n : bake.bentNormals) differences.add(glm::length(glm::dvec3(n)), 1.0);
  finite(bake.sh->coefficients, differences);
  finite(bake.ch->coefficients, differences);
  finite(bake.haar->values, differences);
  finite(bake.glossy->matrices, differences);
  if (bake.lightGroups) finite(bake.lightGroups->coefficients, differences);
  if (bake.volume) finite(bake.volume->coefficients, differences);
  for (const glm::vec4& vector : bake.occluders->vectors)
    for (int k = 0; k < 4; ++k) differences.add(vector[k], vector[k]);
  trials.record(name + ", " +
                    (albedo < 0.0    ? "its own colours"
                     : albedo == 0.0 ? "black"
                                     : "white") +
                    (size == 1.0  ? ""
                     : size > 1.0 ? ", 1e6 times as large"
                                  : ", a millionth as large") +
                    (offset.x == 0.0 ? "" : ", far from zero"),
                differences, 4.0 * unitRoundoff);
}

}  // namespace

void runBakes(Trials& trials) {
  for (const int order : trials.options().orders)
    openFloor("an open floor", 1.0, glm::dvec3(0.0), order, trials);
  openFloor("an open floor of 1e-6 m", 1e-6, glm::dvec3(0.0), 8, trials);
  openFloor("an open floor of 1e6 m", 1e6, glm::dvec3(0.0), 8, trials);
  openFloor("an open floor 1e6 m from zero", 1.0, {1e6, -1e6, 5e5}, 8, trials);
  for (const int bounces : {0, 1, 16})
    bouncingRoom("walls of albedo 0.999 that emit", 1.0, 0.999, 1.0, bounces, trials);
  bouncingRoom("walls of albedo 0", 1.0, 0.0, 1.0, 4, trials);
  bouncingRoom("walls of albedo 1", 1.0, 1.0, 1e6, 16, trials);
  bouncingRoom("walls that emit 1e-6", 1e-6, 0.5, 1e-6, 4, trials);
  litFloor("light from afar", 1.0, farLight({0.0, -1.0, 0.0}, 1.0), 1.0, trials);
  litFloor("light from afar, grazing", 1.0, farLight({1.0, -1e-3, 0.0}, 1e6),
           1e6 * 1e-3 / std::sqrt(1.0 + 1e-6), trials);
  litFloor("a light 1e6 times farther than the scene is large", 1.0, pointLight({0.0, 1e6, 0.0}, 1e12), 1.0,
           trials);
  litFloor("the same in millionths", 1e-6, pointLight({0.0, 1.0, 0.0}, 1e-6), 1e-6, trials);
  closedRoom("a closed room", 1.0, glm::dvec3(0.0), trials);
  closedRoom("a closed room of 1e-6 m", 1e-6, glm::dvec3(0.0), trials);
  closedRoom("a closed room of 1e6 m", 1e6, glm::dvec3(0.0), trials);
  closedRoom("a closed room 1e6 m from zero", 1.0, {1e6, -1e6, 5e5}, trials);
}

void runWholeScenes(Trials& trials) {
  for (const std::string& name : trials.options().scenes) {
    everything(name, 1.0, glm::dvec3(0.0), -1.0, trials);
    everything(name, 1e-6, glm::dvec3(0.0), 1.0, trials);
    everything(name, 1e6, glm::dvec3(0.0), 0.0, trials);
    everything(name, 1.0, {1e6, -1e6, 5e5}, 1.0, trials);
  }
}

}  // namespace prelight::benchmarks::stability
