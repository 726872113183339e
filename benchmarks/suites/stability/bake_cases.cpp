#include <algorithm>
#include <array>
#include <cmath>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "basis/sh_zonal.h"
#include "benchmarks/suites/stability/cases.h"
#include "occluders/occluder_light.h"
#include "occluders/occluder_upload.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "techniques/vector_occluders/occluder_relighter.h"

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

/// Measures an open floor, which has a closed form in every band.
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

/// Measures walls that emit, seen from walls. The truth after B bounces is a sum of powers of the albedo.
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

/// Measures the lights of a group. The truth is irradiance over pi x the group's colour.
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

/// Measures a closed room: it is dark, and its occluders add up to the whole sky.
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
  // The bound is that of the vertex fit (storage_cases.cpp).
  trials.record(stress, differences, 1e-5 * std::sqrt(double(scene.vertexCount())));
}

template <typename Values>
void finite(const Values& values, Differences& differences) {
  for (const auto& value : values) differences.add(double(value), double(value));
}

/// Bakes everything for a scene of any size and place: all numbers must be finite, and AO within its range.
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

namespace {

constexpr std::array<OccluderVector, 8> everyVector = {
    OccluderVector::Position,       OccluderVector::Occlusion,     OccluderVector::Caustic,
    OccluderVector::Transmissive,   OccluderVector::DiffuseNormal, OccluderVector::DiffuseColor,
    OccluderVector::SpecularNormal, OccluderVector::SpecularColor};

struct Made {
  OccluderTransfer transfer;
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec4> gloss;
};

/// Kinds of records, most of them hard for the kernels.
enum class Records { Usual, Thin, Whole, None, Many };

glm::vec4 sumOf(Random& random, double weight, bool none) {
  const double resultant = none ? 0.0 : random.between(0.3, 1.0);
  return {glm::vec3(weight * resultant * random.direction()), static_cast<float>(weight)};
}

Made make(Records kind, double size) {
  Random random(91);
  Made made;
  made.transfer.names = {"a", "b"};
  made.transfer.stored.assign(everyVector.begin(), everyVector.end());
  made.transfer.offsets = {0};
  for (std::size_t v = 0; v < 60; ++v) {
    made.positions.emplace_back(size * 1.5 * random.unit() * random.direction());
    made.normals.emplace_back(random.direction());
    made.gloss.emplace_back(v % 3 == 0 ? 0.0 : random.unit(), v % 3 == 0 ? 0.0 : random.unit(), 0.0,
                            v % 5 == 0 ? 0.0 : random.unit());
    const std::size_t records = kind == Records::Many ? 64 : v % 6;
    for (std::size_t i = 0; i < records; ++i) {
      double weight = random.unit() / double(records);
      if (kind == Records::Thin) weight = 1e-9 * random.unit();
      if (kind == Records::Whole) weight = 1.0;
      if (kind == Records::None) weight = i % 2 == 0 ? 0.0 : 1e-38;
      const bool none = (i + v) % 7 == 0;
      made.transfer.occluders.push_back(static_cast<std::uint32_t>(i % 2));
      made.transfer.vectors.emplace_back(glm::vec3(size * 3.0 * random.direction()),
                                         static_cast<float>(size * random.between(0.2, 3.0)));
      made.transfer.vectors.push_back(sumOf(random, weight, none));
      made.transfer.vectors.push_back(sumOf(random, i % 3 == 0 ? 0.0 : weight * random.unit(), none));
      made.transfer.vectors.emplace_back(random.unit(), i % 2 == 0 ? 0.0 : 1.0, random.unit(), 0.0);
      made.transfer.vectors.push_back(sumOf(random, weight * random.unit(), (i + v) % 5 == 0));
      made.transfer.vectors.emplace_back(1.0, i % 2 == 0 ? 0.0 : 1.0, random.unit(), 0.0);
      made.transfer.vectors.push_back(
          sumOf(random, i % 4 == 0 ? 0.0 : weight * random.unit(), (i + v) % 9 == 0));
      made.transfer.vectors.emplace_back(random.unit(), random.unit(), 1.0, 0.0);
    }
    made.transfer.offsets.push_back(static_cast<std::uint32_t>(made.transfer.occluders.size()));
  }
  return made;
}

std::vector<device::OccluderLight> lightsAt(double distance, double intensity, std::size_t count) {
  Random random(92);
  std::vector<device::OccluderLight> lights;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 way = random.direction();
    lights.push_back(i % 3 == 2
                         ? occluderFarLight(way, glm::dvec3(intensity))
                         : occluderPointLight(distance * way, glm::dvec3(intensity * distance * distance),
                                              1e-3 * distance));
  }
  return lights;
}

const OccluderEye eye{{2.0, 3.0, 5.0}, true};

void shade(const char* stress, const Made& made, const std::vector<device::OccluderLight>& lights,
           OccluderFormula formula, double intensity, Trials& trials) {
  OccluderShading shading;
  shading.formula = formula;
  OccluderRelighter relighter(trials.context(), made.transfer,
                              {made.positions, made.normals, glm::dvec3(0.0), made.gloss});
  Buffer<device::LitVertex> onDevice(trials.context(), relighter.vertexCount());
  Buffer<float> radiance(trials.context(), 3 * relighter.vertexCount());
  relighter.relight(lights, shading, eye, onDevice);
  relighter.takeDiffuse(onDevice, radiance);
  const std::vector<device::LitVertex> lit = onDevice.read();
  const std::vector<float> diffuseLight = radiance.read();
  std::vector<LightAt> sources;
  for (const device::OccluderLight& light : lights)
    sources.emplace_back([&light](const glm::dvec3& point) { return incidentFrom(light, point); });
  std::vector<OccludedLight> truth;
  double diffuse = 0.0;
  for (std::size_t v = 0; v < lit.size(); ++v) {
    OccluderReceiver receiver;
    receiver.vertex = static_cast<std::uint32_t>(v);
    receiver.position = glm::dvec3(made.positions[v]);
    receiver.normal = glm::dvec3(made.normals[v]);
    receiver.toEye = glm::normalize(eye.position - receiver.position);
    receiver.f0 = glm::dvec3(glm::vec3(made.gloss[v]));
    receiver.roughness = made.gloss[v].w;
    truth.push_back(litThroughOccluders(made.transfer, receiver, sources, shading));
    diffuse = std::max({diffuse, truth.back().diffuse.x, truth.back().diffuse.y});
  }
  Differences differences;
  for (std::size_t v = 0; v < lit.size(); ++v)
    for (int c = 0; c < 3; ++c) {
      // Lobes have high peaks, to which their error is relative.
      const double scale = std::max(diffuse, intensity * double(lights.size()) / 3.2);
      differences.add(diffuseLight[3 * v + static_cast<std::size_t>(c)], truth[v].diffuse[c], scale);
      differences.add(lit[v].specular[c], truth[v].specular[c], std::max(scale, truth[v].specular[c]));
      differences.add(lit[v].reflected[c], truth[v].reflected[c], std::max(scale, truth[v].reflected[c]));
      differences.add(lit[v].highlight, lit[v].highlight);
    }
  trials.record(std::string(stress) + (formula == OccluderFormula::Soft ? ", soft" : ", thesis"), differences,
                1e-4 + sumBound(double(lights.size())), {"lights", double(lights.size())});
}

}  // namespace

void runOccluders(Trials& trials) {
  for (const OccluderFormula formula : {OccluderFormula::Soft, OccluderFormula::Thesis}) {
    const Made usual = make(Records::Usual, 1.0);
    shade("any records", usual, lightsAt(4.0, 1.0, 9), formula, 1.0, trials);
    shade("form factors of 1e-9", make(Records::Thin, 1.0), lightsAt(4.0, 1.0, 9), formula, 1.0, trials);
    shade("form factors of 1 each", make(Records::Whole, 1.0), lightsAt(4.0, 1.0, 9), formula, 1.0, trials);
    shade("form factors of 0 and 1e-38", make(Records::None, 1.0), lightsAt(4.0, 1.0, 9), formula, 1.0,
          trials);
    shade("64 records per vertex", make(Records::Many, 1.0), lightsAt(4.0, 1.0, 9), formula, 1.0, trials);
    shade("lights 1e6 times farther", usual, lightsAt(4e6, 1.0, 9), formula, 1.0, trials);
    shade("light of 1e6", usual, lightsAt(4.0, 1e6, 9), formula, 1e6, trials);
    shade("light of 1e-6", usual, lightsAt(4.0, 1e-6, 9), formula, 1e-6, trials);
    shade("a scene of 1e-6 m", make(Records::Usual, 1e-6), lightsAt(4e-6, 1.0, 9), formula, 1.0, trials);
    shade("a scene of 1e6 m", make(Records::Usual, 1e6), lightsAt(4e6, 1.0, 9), formula, 1.0, trials);
    for (std::size_t count = 1; count <= trials.options().lights && count <= 1000; count *= 10)
      shade("more and more lights", usual, lightsAt(4.0, 1.0, count), formula, 1.0, trials);
  }
}

}  // namespace prelight::benchmarks::stability
