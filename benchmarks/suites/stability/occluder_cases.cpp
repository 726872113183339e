#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/suites/stability/cases.h"
#include "occluders/occluder_light.h"
#include "occluders/occluder_upload.h"
#include "techniques/vector_occluders/occluder_relighter.h"

namespace prelight::benchmarks::stability {

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

/// Kinds of records, most of them hard on the kernels.
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
  const std::vector<device::LitVertex> lit = relighter.relight(lights, shading, eye);
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
      // Lobes' peaks are high: what they are off by is relative to them.
      const double scale = std::max(diffuse, intensity * double(lights.size()) / 3.2);
      differences.add(lit[v].diffuse[c], truth[v].diffuse[c], scale);
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
    shade("64 records a vertex", make(Records::Many, 1.0), lightsAt(4.0, 1.0, 9), formula, 1.0, trials);
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
