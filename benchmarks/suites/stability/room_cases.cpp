#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/suites/stability/cases.h"
#include "gi/final_gather.h"
#include "gi/irradiance_cache.h"
#include "radiosity/exchange_solver.h"
#include "radiosity/radiosity.h"
#include "receivers/surface_sampler.h"

// Final gathering and radiosity in rooms with known light.
namespace prelight::benchmarks::stability {

namespace {

std::vector<device::Receiver> receiversOf(const CompiledScene& scene) {
  std::vector<device::Receiver> all;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    for (const glm::vec2& b : {glm::vec2(0.3f, 0.3f), glm::vec2(1e-6f, 1e-6f), glm::vec2(0.5f, 0.49999f),
                               glm::vec2(0.99f, 1e-5f)}) {
      const glm::dvec2 kept = keptOffEdges(scene, t, b);
      all.push_back(
          receiverAt(scene, {t, static_cast<float>(kept.x), static_cast<float>(kept.y), 1.0f}, Side::Front));
      all.back().seed = 31 * t + 5;
      all.back().firstSample = 0;
    }
  return all;
}

/// Adds evenly lit rooms: records, whose gradients must only be finite, and rays of uniform guides.
void addPatterns(FinalGather& gather, std::span<const device::Receiver> receivers, double truth,
                 Differences& differences) {
  Progress progress;
  RecordGather records(gather);
  gather.gather(receivers, records, progress);
  for (const device::GatherRecord& record : records.take())
    for (int c = 0; c < 3; ++c) {
      differences.add(record.irradiance[c], truth);
      for (int k = 0; k < 3; ++k) {
        differences.add(record.translation[c][k], record.translation[c][k]);
        differences.add(record.rotation[c][k], record.rotation[c][k]);
      }
    }
  const std::vector<float> guides(PRELIGHT_GUIDE_CELLS * receivers.size(), 1.0f);
  GuidedGather guided(gather, guides, receivers.size());
  gather.gather(receivers, guided, progress);
  for (const glm::vec3& e : guided.irradiance())
    for (int c = 0; c < 3; ++c) differences.add(e[c], truth);
  BoundedGather bounded(gather, receivers.size());
  gather.gather(receivers, bounded, progress);
  for (const BoundedIrradiance& e : bounded.irradiance())
    for (int c = 0; c < 3; ++c) differences.add(e.bounded[c] + e.excess[c], truth);
}

void gatherRoom(const char* stress, double half, double albedo, double irradiance, const glm::dvec3& offset,
                std::uint32_t rays, Trials& trials) {
  const CompiledScene scene = roomScene(half, 1, matte(albedo), offset);
  TransportScene transport({scene, noImages(), {}}, trials.device());
  LightMapLayout layout;
  layout.width = layout.height = 1;
  layout.corners.assign(6 * std::size_t{scene.triangleCount()}, glm::vec2(0.5f));
  layout.chartOf.assign(2 * std::size_t{scene.triangleCount()}, 0);
  IrradianceMap map(transport.context(), layout);
  const auto known = static_cast<float>(irradiance);
  map.set(std::vector<glm::vec3>(1, glm::vec3(known)));
  GatherRequest request;
  request.raysPerReceiver = rays;
  FinalGather gather(transport, map, request);
  Progress progress;
  const std::vector<device::Receiver> receivers = receiversOf(scene);
  const double truth = double(static_cast<float>(albedo)) * double(known);
  Differences differences;
  for (const glm::vec3& e : gather.gather(receivers, progress))
    for (int c = 0; c < 3; ++c) differences.add(e[c], truth);
  addPatterns(gather, receivers, truth, differences);
  const std::vector<float> incident = gather.gatherIncident(receivers, progress);
  for (std::size_t i = 0; i < incident.size(); ++i) {
    // Irradiance is exact. Values divided by cosines are estimates, which must only be finite.
    if (i % 5 == 0)
      differences.add(incident[i], truth);
    else
      differences.add(incident[i], incident[i]);
  }
  trials.record(stress, differences, sumBound(rays + 16.0), {"rays", double(rays)});
}

/// Returns the light of a point light after rough metal walls of a room. It is exactly proportional to the
/// intensity, since all steps are sums of products with powers of two.
std::vector<glm::vec3> gatherByRoughMetal(float intensity, Trials& trials) {
  Material wall;
  wall.metallic = 1.0f;
  wall.roughness = 0.7f;
  const CompiledScene scene = roomScene(1.0, 1, wall, glm::dvec3(0.0));
  Light light;
  light.intensity = glm::vec3(intensity);
  light.position = {0.2, 0.1, -0.3};
  TransportScene transport({scene, noImages(), {light}}, trials.device());
  LightMapLayout layout;
  layout.width = layout.height = 1;
  layout.corners.assign(6 * std::size_t{scene.triangleCount()}, glm::vec2(0.5f));
  layout.chartOf.assign(2 * std::size_t{scene.triangleCount()}, LightMapLayout::noChart);
  IrradianceMap map(transport.context(), layout);
  map.set(std::vector<glm::vec3>(1, glm::vec3(0.0f)));
  GatherRequest request;
  request.raysPerReceiver = 64;
  Progress progress;
  return FinalGather(transport, map, request).gather(receiversOf(scene), progress);
}

void scaleLight(const char* stress, int exponent, const std::vector<glm::vec3>& ofOne, Trials& trials) {
  const double factor = std::ldexp(1.0, exponent);
  const std::vector<glm::vec3> found = gatherByRoughMetal(static_cast<float>(factor), trials);
  Differences differences;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int c = 0; c < 3; ++c) differences.add(found[i][c], factor * double(ofOne[i][c]));
  trials.record(stress, differences, 0.0, {"exponent", double(exponent)});
}

/// Solves a system in which each element sees all others equally: H_i = D_i + share x albedo x mean of H.
void solve(RadiosityMethod method, const char* stress, int cells, double albedo, double share, double light,
           Trials& trials) {
  const CompiledScene scene = floorScene(1.0, cells, matte(albedo));
  const RadiosityElements elements = makeElements(scene, 10.0);
  const std::uint32_t n = elements.perSide();
  FormFactors factors;
  const float area = elements.areas[0];
  factors.areas.assign(n, area);
  factors.scale.assign(n, 1.0f / area);
  factors.escaped.assign(n, static_cast<float>(1.0 - share));
  factors.albedo.assign(n, glm::vec3(static_cast<float>(albedo)));
  const auto value = static_cast<float>(share * double(area) / n);
  for (std::uint32_t i = 0; i < n; ++i) {
    factors.rowStart.push_back(i * n);
    for (std::uint32_t j = 0; j < n; ++j) {
      factors.columns.push_back(j);
      factors.values.push_back(value);
    }
  }
  factors.rowStart.push_back(n * n);
  const ExchangeSystem system(trials.context(), scene, elements, factors);
  ExchangeSolver solver(system);
  Random random(71);
  std::vector<glm::vec4> direct;
  double mean = 0.0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto d = static_cast<float>(i % 7 == 0 ? light * random.between(0.5, 1.0) : 0.0);
    direct.emplace_back(d, d, d, 0.0f);
    mean += double(d) / n;
  }
  solver.setDirect(direct);
  Progress progress;
  constexpr double tolerance = 1e-6;
  // Southwell's sweeps have n steps each. Residuals of Jacobi and Gauss-Seidel fall by the albedo per sweep.
  solver.solve(method, tolerance, 20000.0, progress);
  const double f = double(value) * n * double(factors.scale[0]), white = double(static_cast<float>(albedo));
  const double around = mean * f * white / (1.0 - f * white);
  Differences differences;
  const std::vector<glm::vec4> got = solver.irradiance();
  for (std::uint32_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) differences.add(got[i][c], double(direct[i][c]) + around, mean + around);
  // The error is up to 1 / (1 - albedo) times the residual, which is the tolerance or due to rounding.
  trials.record(std::string(radiosityMethodNames[static_cast<std::size_t>(method)]) + ", " + stress,
                differences, (tolerance + sumBound(n + 4.0)) / (1.0 - f * white) * 2.0,
                {"elements", double(n)});
}

void furnace(const char* stress, double half, double albedo, double emission, RadiosityMethod method,
             Trials& trials) {
  const CompiledScene scene = roomScene(half, 2, matte(albedo, emission));
  Tracer tracer(scene, trials.device());
  RadiosityOptions options;
  options.raysPerElement = 128;
  options.patchSize = 1.5 * half;
  options.method = method;
  options.tolerance = 1e-6;
  options.maxSweeps = 20000.0;
  Radiosity radiosity(scene, tracer, options);
  Progress progress;
  radiosity.cast(progress);
  radiosity.relight({}, progress);
  const double white = double(static_cast<float>(albedo)),
               truth = pi * double(static_cast<float>(emission)) / (1.0 - white);
  const std::size_t fronts = radiosity.irradianceOfElements().size();
  Differences differences;
  for (std::size_t i = 0; i < fronts; ++i) {
    const glm::vec4 e = radiosity.irradianceOfElements()[i];
    if (radiosity.system().scale().read()[i] <= 0.0f) continue;
    for (int c = 0; c < 3; ++c) differences.add(e[c], truth);
  }
  trials.record(stress, differences, (1e-6 + 2.0 * sumBound(1024.0)) / (1.0 - white),
                {"1 / (1 - albedo)", 1.0 / (1.0 - white)});
}

}  // namespace

void runGather(Trials& trials) {
  for (const std::uint32_t rays : {8u, 64u, 256u})
    gatherRoom("a white room", 1.0, 1.0, 1.0, glm::dvec3(0.0), rays, trials);
  gatherRoom("a black room", 1.0, 0.0, 1e6, glm::dvec3(0.0), 64, trials);
  gatherRoom("irradiance of 1e30", 1.0, 0.5, 1e30, glm::dvec3(0.0), 64, trials);
  gatherRoom("irradiance of 1e-30", 1.0, 0.5, 1e-30, glm::dvec3(0.0), 64, trials);
  gatherRoom("a room of 1e-6 m", 1e-6, 0.5, 1.0, glm::dvec3(0.0), 64, trials);
  gatherRoom("a room of 1e6 m", 1e6, 0.5, 1.0, glm::dvec3(0.0), 64, trials);
  gatherRoom("a room 1e6 m from zero", 1.0, 0.5, 1.0, glm::dvec3(1e6, -1e6, 5e5), 64, trials);
  const std::vector<glm::vec3> ofOne = gatherByRoughMetal(1.0f, trials);
  scaleLight("a light of 2^90 in rough metal", 90, ofOne, trials);
  scaleLight("a light of 2^-90 in rough metal", -90, ofOne, trials);
}

void runSolver(Trials& trials) {
  constexpr std::array methods = {RadiosityMethod::Jacobi, RadiosityMethod::Chebyshev,
                                  RadiosityMethod::GaussSeidel, RadiosityMethod::Southwell};
  for (const RadiosityMethod method : methods) {
    for (const int cells : trials.options().elementCells)
      solve(method, "albedo 0.5", cells, 0.5, 1.0, 1.0, trials);
    const int cells = trials.options().elementCells.front();
    solve(method, "albedo 0", cells, 0.0, 1.0, 1.0, trials);
    solve(method, "albedo 0.999", cells, 0.999, 1.0, 1.0, trials);
    solve(method, "albedo 1, a tenth escapes", cells, 1.0, 0.9, 1.0, trials);
    solve(method, "light of 1e6", cells, 0.9, 1.0, 1e6, trials);
    solve(method, "light of 1e-6", cells, 0.9, 1.0, 1e-6, trials);
  }
}

void runRadiosity(Trials& trials) {
  furnace("walls that emit, albedo 0", 1.0, 0.0, 1.0, RadiosityMethod::GaussSeidel, trials);
  furnace("albedo 0.5", 1.0, 0.5, 1.0, RadiosityMethod::GaussSeidel, trials);
  furnace("albedo 0.999", 1.0, 0.999, 1.0, RadiosityMethod::GaussSeidel, trials);
  furnace("albedo 0.999, Chebyshev", 1.0, 0.999, 1.0, RadiosityMethod::Chebyshev, trials);
  furnace("a room of 1e-6 m", 1e-6, 0.5, 1.0, RadiosityMethod::GaussSeidel, trials);
  furnace("a room of 1e6 m", 1e6, 0.5, 1.0, RadiosityMethod::GaussSeidel, trials);
  furnace("emission of 1e-6", 1.0, 0.5, 1e-6, RadiosityMethod::GaussSeidel, trials);
  furnace("emission of 1e6", 1.0, 0.5, 1e6, RadiosityMethod::GaussSeidel, trials);
}

}  // namespace prelight::benchmarks::stability
