#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <utility>

#include "benchmarks/suites/transfer/incident_light.h"
#include "benchmarks/suites/transfer/transfer_suite.h"
#include "encodings/registry/registry.h"

namespace prelight::benchmarks {

namespace {

constexpr int normalCount = 40;
constexpr double steepest = 45.0;  // largest angle of bumped normals to the surface's, degrees

/// Returns normals in world space, evenly spread over solid angle.
std::vector<glm::vec3> bumpedNormals(const glm::dmat3& frame) {
  const double lowest = std::cos(steepest * std::numbers::pi / 180.0);
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<glm::vec3> normals;
  for (int i = 0; i < normalCount; ++i) {
    const double z = 1.0 - (1.0 - lowest) * (i + 0.5) / normalCount, radius = std::sqrt(1.0 - z * z);
    normals.emplace_back(frame * glm::dvec3(radius * std::cos(golden * i), radius * std::sin(golden * i), z));
  }
  return normals;
}

/// Light at a point and the irradiance that it causes.
struct MeasuredPlace {
  std::vector<float> harmonics;
  glm::mat3 frame;
  std::vector<glm::vec3> normals;
  std::vector<glm::dvec3> irradiance;  ///< [normal], irradiance by the unencoded light
};

std::vector<MeasuredPlace> placesOf(const std::vector<IncidentLight>& lights) {
  std::vector<MeasuredPlace> places;
  for (const IncidentLight& light : lights) {
    MeasuredPlace place{light.harmonics(), glm::mat3(light.frame()), bumpedNormals(light.frame()), {}};
    for (const glm::vec3& normal : place.normals)
      place.irradiance.push_back(light.irradiance(glm::dvec3(normal)));
    places.push_back(std::move(place));
  }
  return places;
}

/// Sums of squares over points, normals and channels.
struct Errors {
  double squares = 0.0;
  double worst = 0.0;  ///< largest length of a difference
  double power = 0.0;  ///< sum of squares of irradiance
  std::size_t count = 0;

  void add(const glm::dvec3& difference, const glm::dvec3& wanted) {
    squares += glm::dot(difference, difference);
    worst = std::max(worst, glm::length(difference));
    power += glm::dot(wanted, wanted);
    ++count;
  }
  double rms() const { return std::sqrt(squares / power); }
  double worstShare() const { return worst / std::sqrt(power / static_cast<double>(count)); }
};

using Values = std::vector<std::vector<float>>;  ///< [place]

Values encodeAll(const Encoding& encoding, const std::vector<MeasuredPlace>& places) {
  Values values;
  for (const MeasuredPlace& place : places) {
    values.emplace_back(encoding.values);
    encoding.encode(place.harmonics, place.frame, values.back());
  }
  return values;
}

Errors errorsOf(const Encoding& encoding, const std::vector<MeasuredPlace>& places, const Values& values) {
  Errors errors;
  for (std::size_t p = 0; p < places.size(); ++p)
    for (std::size_t n = 0; n < places[p].normals.size(); ++n) {
      const glm::dvec3 found(encoding.irradiance(values[p], places[p].frame, places[p].normals[n]));
      errors.add(found - places[p].irradiance[n], places[p].irradiance[n]);
    }
  return errors;
}

/// Returns the processor time of work of one thread, s.
template <typename Work>
double processorSecondsOf(std::size_t rounds, const Work& work) {
  const std::clock_t before = std::clock();
  for (std::size_t round = 0; round < rounds; ++round) work();
  return static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
}

/// Returns the median seconds of one of the `count` calls that `work` makes, over rounds long enough for the
/// clock.
template <typename Work>
double secondsOfOne(int runs, std::size_t count, const Work& work) {
  constexpr double longEnough = 0.05;
  constexpr std::size_t mostRounds = 1u << 16;
  std::size_t rounds = 1;
  while (processorSecondsOf(rounds, work) < longEnough && rounds < mostRounds) rounds *= 2;
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run)
    seconds.push_back(processorSecondsOf(rounds, work) / static_cast<double>(rounds * count));
  return median(std::move(seconds));
}

void reportErrors(const std::string& scene, const std::vector<MeasuredPlace>& places,
                  std::vector<BenchmarkResult>& results) {
  const Encoding& peer = *encodingNamed("sh-3");
  const double peerError = errorsOf(peer, places, encodeAll(peer, places)).rms();
  for (const Encoding& encoding : encodings()) {
    const Errors errors = errorsOf(encoding, places, encodeAll(encoding, places));
    const std::string name = fmt::format("{}/{}", scene, encoding.name);
    BenchmarkResult error{name, "error", errors.rms(), "of irradiance", {}, {}};
    if (encoding.name != peer.name && errors.rms() > 0.0) {
      error.peer = peer.name;
      error.ratio = peerError / errors.rms();
    }
    results.push_back(std::move(error));
    results.push_back({name, "worst error", errors.worstShare(), "of irradiance", {}, {}});
  }
}

void reportCosts(const std::vector<MeasuredPlace>& places, int runs, std::vector<BenchmarkResult>& results) {
  for (const Encoding& encoding : encodings()) {
    Values values = encodeAll(encoding, places);
    const std::string name = fmt::format("all scenes/{}", encoding.name);
    const auto add = [&](const char* metric, double value, const char* unit) {
      results.push_back({name, metric, value, unit, {}, {}});
    };
    add("size", static_cast<double>(encoding.values * sizeof(float)), "bytes/place");
    add("encode time",
        secondsOfOne(runs, places.size(),
                     [&] {
                       for (std::size_t p = 0; p < places.size(); ++p)
                         encoding.encode(places[p].harmonics, places[p].frame, values[p]);
                     }),
        "s/place");
    glm::vec3 sum(0.0f);
    add("evaluation time",
        secondsOfOne(runs, places.size() * normalCount,
                     [&] {
                       for (std::size_t p = 0; p < places.size(); ++p)
                         for (const glm::vec3& normal : places[p].normals)
                           sum += encoding.irradiance(values[p], places[p].frame, normal);
                     }),
        "s/normal");
  }
}

}  // namespace

void runEncodings(const Device& device, const TransferOptions& options, SuiteRun& run) {
  StepCounter steps(run, "bench encodings", options.encodingScenes.size() * options.encodingPlaces);
  const IncidentRequest request{.places = options.encodingPlaces,
                                .side = options.encodingSide,
                                .samples = options.encodingSamples,
                                .seed = 1};
  std::vector<BenchmarkResult>& results = run.results();
  std::vector<MeasuredPlace> all;
  for (const std::string& name : options.encodingScenes) {
    const BenchmarkScene scene = loadBuiltinScene(name);
    std::vector<MeasuredPlace> places = placesOf(measureIncidentLight(scene, request, device, steps));
    reportErrors(name, places, results);
    std::move(places.begin(), places.end(), std::back_inserter(all));
  }
  reportCosts(all, options.runs, results);
}

}  // namespace prelight::benchmarks
