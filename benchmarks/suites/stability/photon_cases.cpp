#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/directions.h"
#include "benchmarks/lab/photon_grid.h"
#include "benchmarks/suites/stability/cases.h"
#include "photon/density_estimator.h"
#include "photon/photon_tracer.h"
#include "receivers/sampling.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "scene/surface/surface_regions.h"

namespace prelight::benchmarks::stability {

namespace {

/// A room with a point light in its middle.
struct LitRoom {
  CompiledScene scene;
  TransportScene transport;

  LitRoom(double half, double albedo, double intensity, Trials& trials)
      : scene(roomScene(half, 1, matte(albedo))),
        transport({scene, noImages(), {pointLight(glm::dvec3(0.0), intensity)}}, trials.device()) {}
};

/// Measures directions and powers of photons with given numbers out of `all`.
void emit(const char* stress, std::uint64_t all, const std::vector<std::uint32_t>& numbers, double intensity,
          Trials& trials) {
  LitRoom room(1.0, 0.0, intensity, trials);
  PhotonTracer tracer(room.scene, room.transport);
  PhotonRequest request;
  request.kind = PhotonKind::All;
  request.photons = all;
  request.flights = true;
  const PhotonSources sources = allSources(room.scene, room.transport.lights(), all, 0);
  PhotonHits hits;
  Progress progress;
  const PhotonReport report = tracer.trace(request, sources, 0, numbers, hits, progress);
  const glm::dvec3 axis = pointLight(glm::dvec3(0.0), 1.0).direction;
  Differences differences;
  for (std::size_t i = 0; i < hits.flights.size(); ++i) {
    const float* d = hits.flights[i].ray.direction;
    const glm::dvec3 direction(d[0], d[1], d[2]);
    const std::uint32_t number = numbers[hits.flightPaths[i]];
    differences.add(glm::dot(direction, axis), 1.0 - 2.0 * sampling::sobol(number, sources.sources[0].seed).y,
                    1.0);
    differences.add(glm::length(direction), 1.0);
  }
  differences.decide(hits.flights.size() == numbers.size());
  const double sent =
      4.0 * pi * double(static_cast<float>(intensity)) * double(numbers.size()) / sources.sources[0].count;
  differences.add(report.power.watts(report.power.emitted).x, sent);
  // Power is counted in units. A photon has 2^26 units, or fewer if these would be denormal floats.
  const double counts =
      sent / double(numbers.size()) / std::max(report.power.unit, double(std::numeric_limits<float>::min()));
  trials.record(stress, differences, 16.0 * unitRoundoff + 1.0 / counts, {"photons", double(all)});
}

/// Measures photons without roulette, whose power falls by the albedo at every surface, so that all sums are
/// known.
void bounce(const char* stress, double half, double albedo, double intensity, Trials& trials) {
  LitRoom room(half, albedo, intensity, trials);
  PhotonTracer tracer(room.scene, room.transport);
  constexpr int depth = 12;
  PhotonRequest request;
  request.kind = PhotonKind::All;
  request.photons = trials.options().flownPhotons;
  request.depth = request.rouletteDepth = depth;
  double stored = 0.0;
  const PhotonTracer::Sink sum = [&](const PhotonHits& block) {
    for (const device::Photon& photon : block.photons) stored += double(photon.power[0]);
  };
  Progress progress;
  const PhotonReport report = tracer.trace(request, sum, progress);
  const double white = double(static_cast<float>(albedo)),
               sent = 4.0 * pi * double(static_cast<float>(intensity));
  double expected = 0.0, left = sent;
  for (int k = 0; k < depth; ++k) {
    expected += left;
    left *= white;
  }
  if (albedo == 0.0) expected = 0.0;  // black surfaces keep no photons
  Differences differences;
  differences.add(stored, expected, sent * depth);
  const PhotonPower& power = report.power;
  differences.add(power.watts(power.emitted).x, sent);
  differences.add(power.watts(power.cut).x, left, sent);
  differences.add(power.watts(power.escaped).x, 0.0, sent);
  for (std::size_t c = 0; c < 3; ++c)
    differences.decide(power.emitted[c] == power.absorbed[c] + power.escaped[c] + power.cut[c]);
  trials.record(stress, differences, 8.0 * depth * unitRoundoff, {"albedo", white});
}

/// Measures roulette of photons with less than `least` of their initial power: no power is lost uncounted,
/// and none carries more than it had or the least.
void endUnimportant(const char* stress, double least, double intensity, Trials& trials) {
  LitRoom room(1.0, 0.5, intensity, trials);
  PhotonTracer tracer(room.scene, room.transport);
  PhotonRequest request;
  request.kind = PhotonKind::All;
  request.photons = trials.options().flownPhotons;
  request.rouletteDepth = request.depth = 12;
  PhotonSources sources = allSources(room.scene, room.transport.lights(), request.photons, 0);
  const double each = 4.0 * pi * intensity / sources.sources[0].count;
  sources.least = LeastPower{{{-1.0f, -1.0f, -1.0f}, 0.5f, 1}, {static_cast<float>(least * each)}};
  PhotonHits hits;
  Progress progress;
  const PhotonReport report = tracer.trace(request, sources, hits, progress);
  double most = 0.0;
  for (const device::Photon& photon : hits.photons) most = std::max(most, double(photon.power[0]));
  Differences differences;
  differences.add(std::max(most, std::max(1.0, least) * each), std::max(1.0, least) * each);
  const PhotonPower& power = report.power;
  for (std::size_t c = 0; c < 3; ++c)
    differences.decide(power.emitted[c] == power.absorbed[c] + power.escaped[c] + power.cut[c]);
  trials.record(stress, differences, 16.0 * unitRoundoff, {"least power", least});
}

/// Measures mirrors and glass: power must be finite, and no more than was emitted.
void caustics(const char* stress, double factor, bool all, Trials& trials) {
  Warnings warnings;
  GltfDocument document = makeBuiltinScene("caustics");
  const Scene loaded = loadScene(document, warnings);
  const CompiledScene scene = compileScene(loaded, warnings);
  std::vector<Light> lights = scene.lights;
  for (Light& light : lights) light.intensity *= static_cast<float>(factor);
  TransportScene transport({scene, loaded.images, lights}, trials.device());
  PhotonTracer tracer(scene, transport);
  PhotonRequest request;
  request.kind = all ? PhotonKind::Indirect : PhotonKind::Caustic;
  request.photons = trials.options().flownPhotons;
  PhotonHits hits;
  Progress progress;
  const PhotonReport report = tracer.trace(request, hits, progress);
  Differences differences;
  for (const device::Photon& photon : hits.photons)
    for (int c = 0; c < 3; ++c) {
      differences.add(photon.power[c], photon.power[c]);
      differences.add(photon.position[c], photon.position[c]);
    }
  const PhotonPower& power = report.power;
  for (std::size_t c = 0; c < 3; ++c)
    differences.decide(power.emitted[c] == power.absorbed[c] + power.escaped[c] + power.cut[c]);
  trials.record(stress, differences, 0.0);
}

/// Photons on a square, and the estimate at a point from all of them in double precision.
struct Lattice {
  double half;
  CompiledScene scene;
  DensitySurface surface;
  std::vector<device::Photon> photons;
  static constexpr int cells = 8;

  Lattice(double size, std::size_t count, double power, bool coincident)
      : half(size),
        scene(floorScene(size, cells, matte(1.0))),
        surface(makeDensitySurface(scene, makeSurfaceRegions(scene, usualCreaseAngle))) {
    Random random(61);
    for (std::size_t i = 0; i < count; ++i) {
      glm::vec3 p(half * random.between(-1.0, 1.0), 0.0, half * random.between(-1.0, 1.0));
      if (coincident && i > 0 && i % 2 == 0)
        p = {photons.back().position[0], 0.0f, photons.back().position[2]};
      const auto watts = static_cast<float>(power * random.between(0.5, 1.5));
      photons.push_back(
          {{p.x, 0.0f, p.z}, triangleAt(p), {watts, 0.5f * watts, 0.0f}, packDirection(glm::dvec3(0, 1, 0))});
    }
  }

  /// Returns the triangle at a point. Quads run along z first; the diagonal goes from corner to corner.
  std::uint32_t triangleAt(const glm::vec3& p) const {
    const double a = std::clamp((double(p.z) / half + 1.0) * 0.5 * cells, 0.0, cells - 1e-9),
                 b = std::clamp((double(p.x) / half + 1.0) * 0.5 * cells, 0.0, cells - 1e-9);
    const int i = static_cast<int>(a), j = static_cast<int>(b);
    return static_cast<std::uint32_t>(2 * (j * cells + i) + (b - j > a - i ? 1 : 0));
  }

  device::DensityQuery query(const glm::vec3& p, double radius) const {
    return {{p.x, 0.0f, p.z}, triangleAt(p), {0, 1, 0}, static_cast<float>(radius), PRELIGHT_WHOLE_REGION};
  }

  /// Returns irradiance, given the share of the disc that lies on the square. `certain`: no photon lies so
  /// near to the border that rounding decides.
  double estimate(const device::DensityQuery& q, const DensityOptions& options, double share,
                  bool* certain) const {
    std::vector<std::pair<double, double>> reached;
    for (const device::Photon& photon : photons)
      reached.emplace_back(
          std::hypot(double(photon.position[0]) - q.position[0], double(photon.position[2]) - q.position[2]),
          double(photon.power[0]));
    double r = q.radius;
    if (options.nearest > 0) {
      std::sort(reached.begin(), reached.end());
      r = std::min(r, reached[static_cast<std::size_t>(options.nearest - 1)].first);
    }
    double sum = 0.0;
    *certain = true;
    for (const auto& [distance, power] : reached) {
      const double t = distance / r;
      if (options.kernel == DensityKernel::Constant && std::abs(t - 1.0) < 1e-5 && t != 1.0) *certain = false;
      if (t < 1.0)
        sum += power * (options.kernel == DensityKernel::Constant ? 1.0
                        : options.kernel == DensityKernel::Cone   ? 1.0 - t
                                                                  : 1.0 - t * t);
    }
    const double whole = options.kernel == DensityKernel::Constant ? 1.0
                         : options.kernel == DensityKernel::Cone   ? 1.0 / 3.0
                                                                   : 0.5;
    return sum / (share * whole * pi * r * r);
  }
};

struct Placed {
  device::DensityQuery query;
  double share;  ///< share of the disc that lies on the square
};

std::vector<Placed> placesOf(const Lattice& lattice, double radius) {
  Random random(62);
  const auto h = static_cast<float>(lattice.half);
  std::vector<Placed> places;
  for (int i = 0; i < 24; ++i) {
    const double inner = 1.0 - radius;
    places.push_back({lattice.query(glm::vec3(lattice.half * inner * random.between(-1.0, 1.0), 0.0,
                                              lattice.half * inner * random.between(-1.0, 1.0)),
                                    lattice.half * radius),
                      1.0});
    places.push_back(
        {lattice.query({h, 0.0f, static_cast<float>(lattice.half * inner * random.between(-1.0, 1.0))},
                       lattice.half * radius),
         0.5});
  }
  places.push_back({lattice.query({h, 0.0f, h}, lattice.half * radius), 0.25});
  places.push_back({lattice.query({-h, 0.0f, h}, lattice.half * radius), 0.25});
  return places;
}

enum class Finder { Trees, Incident, Grid };

void estimateDensity(const std::string& stress, const Lattice& lattice, const DensityOptions& options,
                     Finder finder, Trials& trials) {
  const double radius = 0.3;
  const std::vector<Placed> places = placesOf(lattice, radius);
  std::vector<device::DensityQuery> queries;
  for (const Placed& place : places) queries.push_back(place.query);
  std::vector<float> got(queries.size());
  std::vector<float> incident;
  if (finder == Finder::Grid) {
    PhotonGridEstimator grid(lattice.surface, options.nearest, trials.device());
    grid.setPhotons(lattice.photons, 4.0, 0.0);
    const Buffer<device::DensityQuery> buffer(trials.context(),
                                              std::span<const device::DensityQuery>(queries));
    Buffer<float> out(trials.context(), 3 * queries.size());
    grid.estimate(buffer, queries.size(), out);
    const std::vector<float> all = out.read();
    for (std::size_t i = 0; i < got.size(); ++i) got[i] = all[3 * i];
  } else {
    DensityEstimator estimator(lattice.surface, options, trials.device());
    estimator.setPhotons(makePhotonMaps(lattice.photons, lattice.surface));
    if (finder == Finder::Incident) incident = estimator.estimateIncident(queries);
    const std::vector<glm::vec3> all =
        finder == Finder::Trees ? estimator.estimate(queries) : std::vector<glm::vec3>();
    for (std::size_t i = 0; i < got.size(); ++i)
      got[i] = finder == Finder::Trees ? all[i].x : incident[15 * i];
  }
  Differences differences;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    bool certain = false;
    const double truth = lattice.estimate(queries[i], options, places[i].share, &certain);
    if (certain) differences.add(got[i], truth);
    // For photons from straight above, radiance coefficients follow from the irradiance, except for the
    // packing of directions.
    if (finder == Finder::Incident && certain)
      differences.add(incident[15 * i + 1] / 300.0, truth * 0.28209479177387814 / 300.0, truth);
  }
  trials.record(stress, differences,
                sumBound(double(lattice.photons.size()) * pi * radius * radius / 4.0 / 8.0 + 16.0) +
                    64.0 * unitRoundoff,
                {"photons", double(lattice.photons.size())});
}

/// Measures guide densities, whose mean must be 1 for any photons.
void guideRays(const std::string& stress, const Lattice& lattice, Trials& trials) {
  std::vector<device::DensityQuery> queries;
  for (const Placed& place : placesOf(lattice, 0.3)) queries.push_back(place.query);
  DensityEstimator estimator(lattice.surface, {.nearest = 50}, trials.device());
  estimator.setPhotons(makePhotonMaps(lattice.photons, lattice.surface));
  const std::vector<float> guides = estimator.guides(queries);
  Differences differences;
  for (std::size_t i = 0; i < guides.size(); i += PRELIGHT_GUIDE_CELLS) {
    double sum = 0.0;
    for (std::size_t k = 0; k < PRELIGHT_GUIDE_CELLS; ++k) sum += double(guides[i + k]);
    differences.add(sum, double(PRELIGHT_GUIDE_CELLS));
  }
  trials.record(stress, differences, sumBound(PRELIGHT_GUIDE_CELLS + 16.0),
                {"photons", double(lattice.photons.size())});
}

}  // namespace

void runPhotons(Trials& trials) {
  const std::uint64_t most = trials.options().photons;
  std::vector<std::uint32_t> first, last, end;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    first.push_back(i);
    last.push_back(static_cast<std::uint32_t>(most - 1 - i));
    end.push_back(0xefffffffu - 7u * i);
  }
  emit("the first of many photons", most, first, 1.0, trials);
  emit("the last of many photons", most, last, 1.0, trials);
  emit("the last of 4e9 photons", 0xf0000000u, end, 1.0, trials);
  emit("many photons of 1e-6 W/sr", most, last, 1e-6, trials);
  emit("many photons of 1e6 W/sr", most, last, 1e6, trials);
  emit("many photons of 1e-25 W/sr", most, last, 1e-25, trials);
  for (const double albedo : {0.0, 0.5, 0.999, 1.0}) {
    bounce("a closed room", 1.0, albedo, 1.0, trials);
    bounce("a room of 1e-6 m", 1e-6, albedo, 1e6, trials);
    bounce("a room of 1e6 m", 1e6, albedo, 1e-6, trials);
  }
  for (const double least : {1e-6, 0.3, 1.0, 8.0}) {
    endUnimportant("photons that end by chance", least, 1.0, trials);
    endUnimportant("photons of 1e-25 W/sr that end by chance", least, 1e-25, trials);
  }
  for (const double factor : {1.0, 1e6, 1e-6}) {
    caustics("mirrors and glass", factor, false, trials);
    caustics("mirrors and glass, indirect light", factor, true, trials);
  }
}

void runDensity(Trials& trials) {
  constexpr std::array<std::pair<DensityKernel, const char*>, 3> kernels = {
      {{DensityKernel::Constant, "constant kernel"},
       {DensityKernel::Cone, "cone"},
       {DensityKernel::Epanechnikov, "Epanechnikov"}}};
  for (const std::size_t count : trials.options().densityPhotons)
    for (const auto& [kernel, name] : kernels)
      for (const int nearest : {0, 50}) {
        const std::string how = std::string(name) + (nearest > 0 ? ", 50 nearest" : "");
        estimateDensity(how, Lattice(1.0, count, 1.0, false), {.kernel = kernel, .nearest = nearest},
                        Finder::Trees, trials);
      }
  const std::size_t few = trials.options().densityPhotons.front();
  for (const double power : {1e-30, 1.0, 1e30})
    guideRays(fmt::format("guides of photons of {:g} W", power), Lattice(1.0, few, power, false), trials);
  for (const Finder finder : {Finder::Trees, Finder::Incident, Finder::Grid}) {
    const std::string how = finder == Finder::Trees      ? ", trees"
                            : finder == Finder::Incident ? ", with directions"
                                                         : ", grid";
    for (const int nearest : {0, 50}) {
      const DensityOptions options{.nearest = nearest};
      const std::string k = how + (nearest > 0 ? ", nearest" : "");
      estimateDensity("a square of 1 m" + k, Lattice(1.0, few, 1.0, false), options, finder, trials);
      estimateDensity("a square of 1e-6 m" + k, Lattice(1e-6, few, 1.0, false), options, finder, trials);
      estimateDensity("a square of 1e6 m" + k, Lattice(1e6, few, 1.0, false), options, finder, trials);
      estimateDensity("photons of 1e-30 W" + k, Lattice(1.0, few, 1e-30, false), options, finder, trials);
      estimateDensity("photons of 1e30 W" + k, Lattice(1.0, few, 1e30, false), options, finder, trials);
      estimateDensity("photons in pairs at one place" + k, Lattice(1.0, few, 1.0, true), options, finder,
                      trials);
    }
  }
}

}  // namespace prelight::benchmarks::stability
