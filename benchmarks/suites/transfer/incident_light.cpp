#include "benchmarks/suites/transfer/incident_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "basis/sh_evaluate.h"
#include "encodings/encoding.h"
#include "integrators/path_tracer.h"
#include "oracle/brute_force.h"

namespace prelight::benchmarks {

namespace {

/// Distance of an eye from the surface at which it is placed, in diagonals of the scene.
constexpr double offset = 1e-5;
constexpr int depth = 8;  // segments of a path

struct Place {
  glm::dvec3 position{0.0};  ///< scene coordinates
  glm::dmat3 frame{1.0};
  std::uint32_t triangle = 0;
};

class Places {
 public:
  Places(const CompiledScene& scene, std::uint64_t seed) : scene_(scene), random_(seed) {
    double area = 0.0;
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
      const CompiledMaterial& material = scene.materials[scene.triangleMaterials[t]];
      const bool reflects = std::max({material.albedo.r, material.albedo.g, material.albedo.b}) > 0.0f;
      area += reflects ? glm::length(geometricNormal(scene, t)) : 0.0;
      areas_.push_back(area);
    }
  }

  Place next() {
    std::uniform_real_distribution<double> uniform;
    const auto found = std::upper_bound(areas_.begin(), areas_.end(), uniform(random_) * areas_.back());
    Place place;
    place.triangle = static_cast<std::uint32_t>(found - areas_.begin());
    const glm::uvec3& corners = scene_.triangles[place.triangle];
    const double root = std::sqrt(uniform(random_)), v = root * uniform(random_);
    place.position = (1.0 - root) * glm::dvec3(scene_.positions[corners.x]) +
                     (root - v) * glm::dvec3(scene_.positions[corners.y]) +
                     v * glm::dvec3(scene_.positions[corners.z]);
    const glm::dvec3 normal = glm::normalize(geometricNormal(scene_, place.triangle));
    const glm::dvec3 helper = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 tangent = glm::normalize(glm::cross(helper, normal));
    place.frame = {tangent, glm::cross(normal, tangent), normal};
    return place;
  }

 private:
  const CompiledScene& scene_;
  std::mt19937_64 random_;
  std::vector<double> areas_;  ///< [triangle], twice the sum of areas up to this triangle
};

/// Renders pictures of 90 degrees from one point.
class Eye {
 public:
  Eye(const BenchmarkScene& scene, const IncidentRequest& request, const Device& device)
      : scene_(scene.compiled), transport_({scene.compiled, scene.scene.images, scene.scene.lights}, device) {
    request_.samples = request.samples;
    request_.depth = depth;
    request_.seed = request.seed;
    request_.width = request_.height = request.side;
  }

  Picture look(const glm::dvec3& from, const glm::dvec3& right, const glm::dvec3& up) {
    Camera camera;
    camera.world[0] = glm::dvec4(right, 0.0);
    camera.world[1] = glm::dvec4(up, 0.0);
    camera.world[2] = glm::dvec4(glm::cross(right, up), 0.0);
    camera.world[3] = glm::dvec4(from, 1.0);
    camera.yFov = 0.5 * std::numbers::pi;
    camera.zNear = 0.0;
    reference::PathTracer tracer(transport_, scene_, camera, request_);
    reference::Film film(request_.width, request_.height);
    while (film.passes * reference::samplesPerPass(request_) < request_.samples) {
      const std::uint64_t left = film.pixelCount() - film.blockPixels;
      film.add(tracer.trace(film.passes, static_cast<std::uint32_t>(film.blockPixels),
                            static_cast<std::uint32_t>(std::min<std::uint64_t>(left, tracer.blockPixels()))));
    }
    request_.seed += 1;
    return film.picture();
  }

 private:
  const CompiledScene& scene_;
  TransportScene transport_;
  reference::ReferenceRequest request_;
};

/// Adds the light of a picture above the horizon of `normal`. The solid angle of a pixel at (x, y) on the
/// plane at distance 1 is its area over (1 + x^2 + y^2)^(3/2).
void addPicture(const Picture& picture, const glm::dvec3& right, const glm::dvec3& up,
                const glm::dvec3& normal, std::vector<IncidentLight::Sample>& samples) {
  const double step = 2.0 / picture.width;
  for (int row = 0; row < picture.height; ++row)
    for (int column = 0; column < picture.width; ++column) {
      const double x = (column + 0.5) * step - 1.0, y = 1.0 - (row + 0.5) * step;
      const glm::dvec3 radiance(
          picture.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) +
                         static_cast<std::size_t>(column)]);
      const glm::dvec3 way = x * right + y * up - glm::cross(right, up);
      const double length = glm::length(way);
      if (glm::dot(way, normal) <= 0.0 || radiance == glm::dvec3(0.0)) continue;
      samples.push_back({way / length, radiance * (step * step / (length * length * length))});
    }
}

void addPointLights(const BenchmarkScene& scene, const Place& place,
                    std::vector<IncidentLight::Sample>& samples) {
  for (const Light& light : scene.scene.lights) {
    if (light.type != LightType::Point) continue;
    const glm::dvec3 way = light.position - scene.compiled.origin - place.position;
    const double distance = glm::length(way);
    const glm::dvec3 direction = way / distance;
    if (glm::dot(direction, place.frame[2]) <= 0.0 ||
        reference::closestHit(scene.compiled, place.position, direction, distance, place.triangle))
      continue;
    samples.push_back({direction, glm::dvec3(light.intensity) / (distance * distance)});
  }
}

std::vector<IncidentLight::Sample> lightAt(const BenchmarkScene& scene, const Place& place, Eye& eye) {
  const double diagonal =
      glm::length(glm::dvec3(scene.compiled.boundsMax) - glm::dvec3(scene.compiled.boundsMin));
  const glm::dvec3 from = scene.compiled.origin + place.position + offset * diagonal * place.frame[2];
  const glm::dvec3 t = place.frame[0], b = place.frame[1], n = place.frame[2];
  // Cameras look along -cross(right, up): at the zenith, then along b, -b, -t and t with the normal upwards.
  const std::array<std::array<glm::dvec3, 2>, 5> views = {{{b, t}, {t, n}, {-t, n}, {b, n}, {-b, n}}};
  std::vector<IncidentLight::Sample> samples;
  for (const auto& [right, up] : views) addPicture(eye.look(from, right, up), right, up, n, samples);
  addPointLights(scene, place, samples);
  return samples;
}

}  // namespace

glm::dvec3 IncidentLight::irradiance(const glm::dvec3& normal) const {
  glm::dvec3 sum(0.0);
  for (const Sample& sample : samples_)
    sum += std::max(glm::dot(sample.direction, normal), 0.0) * sample.power;
  return sum;
}

std::vector<float> IncidentLight::harmonics() const {
  std::vector<double> sums(3 * incidentTerms), values(incidentTerms);
  for (const Sample& sample : samples_) {
    sh::evaluate(sample.direction, incidentOrder, values);
    for (int channel = 0; channel < 3; ++channel)
      for (std::size_t i = 0; i < incidentTerms; ++i)
        sums[static_cast<std::size_t>(channel) * incidentTerms + i] += values[i] * sample.power[channel];
  }
  return {sums.begin(), sums.end()};
}

std::vector<IncidentLight> measureIncidentLight(const BenchmarkScene& scene, const IncidentRequest& request,
                                                const Device& device, StepCounter& steps) {
  Eye eye(scene, request, device);
  Places places(scene.compiled, request.seed);
  std::vector<IncidentLight> lights;
  const std::size_t mostTries = 10 * request.places;  // points inside objects are dark
  for (std::size_t tries = 0; lights.size() < request.places && tries < mostTries; ++tries) {
    const Place place = places.next();
    IncidentLight light(place.frame, lightAt(scene, place, eye));
    if (glm::length(light.irradiance(place.frame[2])) < 1e-6) continue;
    lights.push_back(std::move(light));
    steps.advance();
  }
  return lights;
}

}  // namespace prelight::benchmarks
