#include "radiosity/radiosity.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "fit/vertex_fit.h"
#include "radiosity/elements.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t mostDirectPoints = 8;
constexpr float raysThatTell = 64.0f;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Radiosity::Radiosity(const CompiledScene& scene, Tracer& tracer, const RadiosityOptions& options)
    : scene_(scene), tracer_(tracer), options_(options) {
  report_.patchSize = options.patchSize > 0.0 ? options.patchSize : defaultPatchSize(scene);
  report_.method = options.method;
  elements_ = makeElements(scene, report_.patchSize);
  cast_.emplace(scene, elements_, tracer, options.raysPerElement, options.seed);
}

void Radiosity::cast(Progress& progress) {
  const auto start = Clock::now();
  cast_->run(progress);
  report_.castSeconds += secondsSince(start);
  report_.castRays = cast_->rays();
  makeRows();
}

void Radiosity::makeRows() {
  const auto start = Clock::now();
  const ExchangeCounts& counts = cast_->counts();
  factors_ = makeFormFactors(elements_, counts, options_.maxMemory);
  for (std::uint32_t row = 0; row < counts.elements.size(); ++row) {
    if (counts.rays[row] == 0) continue;
    lit_.push_back(counts.elements[row]);
    valid_.push_back(counts.valid[row]);
  }
  directLight_.emplace(scene_, cast_->points(), tracer_,
                       std::min(mostDirectPoints, cast_->pointsPerElement()));
  system_.emplace(tracer_.context(), scene_, elements_, factors_);
  solver_.emplace(*system_);
  report_.elements = lit_.size();
  report_.entries = factors_.values.size();
  report_.rowSeconds += secondsSince(start);
}

/// Returns the irradiance due to emissive elements by the form factors, [element]. `share` receives the sum
/// of form factors to them.
std::vector<glm::vec4> Radiosity::emissionThroughRows(std::vector<float>& share) const {
  const std::uint32_t n = factors_.elementCount();
  std::vector<glm::vec4> exitance(n, glm::vec4(0.0f)), irradiance(n, glm::vec4(0.0f));
  share.assign(n, 0.0f);
  for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t) {
    const std::vector<glm::vec3> emission = emissionOfElements(scene_, elements_, t);
    if (emission.empty()) continue;
    const CompiledMaterial& m = scene_.materials[scene_.triangleMaterials[t]];
    for (std::uint32_t side = 0; side < n / elements_.perSide(); ++side)
      for (std::uint32_t i = 0; i < emission.size() && (m.doubleSided || side == 0); ++i)
        exitance[side * elements_.perSide() + elements_.first[t] + i] =
            glm::vec4(std::numbers::pi_v<float> * emission[i], shines(emission[i]) ? 1.0f : 0.0f);
  }
  parallelRanges(n, 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      glm::dvec4 sum(0.0);
      for (std::uint32_t k = factors_.rowStart[i]; k < factors_.rowStart[i + 1]; ++k)
        sum += double(factors_.values[k]) * glm::dvec4(exitance[factors_.columns[k]]);
      sum *= factors_.scale[i];
      irradiance[i] = glm::vec4(glm::vec3(sum), 0.0f);
      share[i] = static_cast<float>(sum.w);
    }
  });
  return irradiance;
}

/// Averages the valid points. With many emitters, form factors are more precise than a few shadow rays
/// wherever enough of the element's rays have hit emitters.
void Radiosity::sumPoints(const std::vector<PointIrradiance>& points, bool manyEmitters) {
  const std::uint32_t perElement = directLight_->pointsPerElement();
  std::vector<float> share;
  std::vector<glm::vec4> carried;
  if (manyEmitters) carried = emissionThroughRows(share);
  directPoints_.assign(points.size(), glm::vec4(0.0f));
  pointMeans_.assign(factors_.elementCount(), glm::vec4(0.0f));
  directElements_ = pointMeans_;
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    const std::uint32_t element = lit_[i];
    const bool throughRow =
        !carried.empty() && share[element] * float(options_.raysPerElement) > raysThatTell;
    glm::dvec3 sum(0.0);
    int count = 0;
    for (std::uint32_t p = 0; p < perElement; ++p) {
      if ((valid_[i] >> p & 1u) == 0) continue;
      const PointIrradiance& light = points[i * perElement + p];
      directPoints_[i * perElement + p] = throughRow ? light.far : light.far + light.emitters;
      sum += glm::dvec3(directPoints_[i * perElement + p]);
      ++count;
    }
    if (count > 0) pointMeans_[element] = glm::vec4(glm::vec3(sum / double(count)), 0.0f);
    directElements_[element] = pointMeans_[element] + (throughRow ? carried[element] : glm::vec4(0.0f));
  }
}

/// Estimates direct light. The light of emissive triangles does not change and is computed once.
std::vector<PointIrradiance> Radiosity::estimateDirect(const RadiosityLights& lights, Progress& progress) {
  RadiosityLights unknown = lights;
  unknown.emitters = lights.emitters && !emitters_;
  directLight_->setLights(unknown);
  std::vector<PointIrradiance> points = directLight_->estimate(lit_, progress);
  if (!lights.emitters) return points;
  if (!emitters_) {
    emitters_.emplace();
    emitters_->areMany = directLight_->manyEmitters();
    for (const PointIrradiance& point : points) emitters_->points.push_back(point.emitters);
  }
  for (std::size_t i = 0; i < points.size(); ++i) points[i].emitters = emitters_->points[i];
  return points;
}

void Radiosity::setLights(const RadiosityLights& lights, Progress& progress) {
  const auto start = Clock::now();
  const std::vector<PointIrradiance> points = estimateDirect(lights, progress);
  sumPoints(points, lights.emitters && emitters_->areMany);
  solver_->setDirect(directElements_);
  report_.directRays = directLight_->rays();
  report_.directSeconds += secondsSince(start);
}

const SolveReport& Radiosity::solve(Progress& progress, std::optional<double> maxSweeps) {
  const auto start = Clock::now();
  report_.solve =
      solver_->solve(options_.method, options_.tolerance, maxSweeps.value_or(options_.maxSweeps), progress);
  report_.solveSeconds += secondsSince(start);
  return report_.solve;
}

const SolveReport& Radiosity::relight(const RadiosityLights& lights, Progress& progress) {
  setLights(lights, progress);
  return solve(progress);
}

std::vector<float> Radiosity::fitDirect(const FitMesh& mesh, double meanArea,
                                        const Progress& progress) const {
  VertexFit fit(mesh, 3);
  const std::uint32_t points = directLight_->pointsPerElement();
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    if (elements_.sideOf(lit_[i]) == Side::Back) continue;
    const std::uint32_t triangle = elements_.triangleOf(lit_[i]);
    for (std::uint32_t p = 0; p < points; ++p) {
      if ((valid_[i] >> p & 1u) == 0) continue;
      SurfaceSample sample = cast_->points().at(lit_[i], triangle, p, 1).sample;
      sample.weight = static_cast<float>(elements_.areas[triangle] / meanArea / points);
      const glm::vec4& d = directPoints_[i * points + p];
      fit.add(sample, std::array<double, 3>{d.x, d.y, d.z});
    }
  }
  return fit.solve(defaultSmoothing, {.progress = &progress});
}

std::vector<float> Radiosity::fitIndirect(const FitMesh& mesh, double meanArea,
                                          const Progress& progress) const {
  VertexFit fit(mesh, 3);
  const std::vector<glm::vec4> irradiance = solver_->irradiance();
  for (const std::uint32_t element : lit_) {
    if (elements_.sideOf(element) == Side::Back) continue;
    const std::uint32_t triangle = elements_.triangleOf(element);
    const glm::dvec2 b =
        pointOfPiece(elements_.splits[triangle], element - elements_.first[triangle], glm::dvec2(1.0 / 3.0));
    const SurfaceSample sample{triangle, static_cast<float>(b.x), static_cast<float>(b.y),
                               static_cast<float>(factors_.areas[element] / meanArea)};
    const glm::vec4 indirect = irradiance[element] - pointMeans_[element];
    fit.add(sample, std::array<double, 3>{indirect.x, indirect.y, indirect.z});
  }
  return fit.solve(defaultSmoothing, {.progress = &progress});
}

VertexLight Radiosity::lightOfVertices(const FitMesh& mesh, const Progress& progress) const {
  double area = 0.0;
  for (const std::uint32_t element : lit_) area += factors_.areas[element];
  const double meanArea = area / std::max<double>(1.0, double(lit_.size()));
  const auto spread = [&](const std::vector<float>& fitted) {
    std::vector<glm::vec3> vertices;
    for (const std::uint32_t slot : mesh.slotOfVertex) {
      const float* value = &fitted[3 * std::size_t{slot}];
      vertices.emplace_back(value[0], value[1], value[2]);
    }
    return vertices;
  };
  return {spread(fitDirect(mesh, meanArea, progress)), spread(fitIndirect(mesh, meanArea, progress))};
}

std::vector<glm::vec3> Radiosity::irradianceOfVertices(const FitMesh& mesh, const Progress& progress) const {
  const VertexLight light = lightOfVertices(mesh, progress);
  const glm::vec3 one(1.0f);
  return irradianceOf({&light, 1}, {&one, 1});
}

std::vector<glm::vec3> irradianceOf(std::span<const VertexLight> lights, std::span<const glm::vec3> factors) {
  std::vector<glm::vec3> vertices(lights.front().direct.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    glm::vec3 direct(0.0f), indirect(0.0f);
    for (std::size_t g = 0; g < lights.size(); ++g) {
      direct += factors[g] * lights[g].direct[v];
      indirect += factors[g] * lights[g].indirect[v];
    }
    const glm::vec3 sum = glm::max(direct, 0.0f) + glm::max(indirect, 0.0f);
    for (int c = 0; c < 3; ++c) vertices[v][c] = std::isfinite(sum[c]) ? sum[c] : 0.0f;
  }
  return vertices;
}

}  // namespace prelight
