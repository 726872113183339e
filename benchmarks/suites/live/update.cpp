#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "base/colour.h"
#include "benchmarks/suites/live/live_suite.h"
#include "benchmarks/suites/live/moving_room.h"
#include "charts/make_light_map_layout.h"
#include "gi/indirect_light.h"
#include "gi/update/live_light.h"
#include "prelight/error.h"
#ifdef PRELIGHT_WITH_VIEWER
#include "benchmarks/suites/live/live_drawing.h"
#endif

namespace prelight::benchmarks {

namespace {

const char* const thesisPeer = "Larsen 2004";
constexpr double thesisFrame = 1.0 / 35.0;  // s, of which drawing is a part there
constexpr int drawnEvery = 8;               // frames: OpenGL may well be software
constexpr int mostFrames = 2000;            // until light has settled

/// The setting of Larsen (2004, ch. 14): 77 groups of 40 photons, 140 texels of which 20 are gathered a frame
/// with 32 x 32 rays, 10 000 photons of caustics over 8 frames.
LiveLightOptions thesisOptions(ChangeDetection detection) {
  LiveLightOptions options;
  options.photons = 3080;
  options.groupSize = 40;
  options.detection = detection;
  options.texels = 140;
  options.estimatesPerFrame = 0;
  options.gather.rays = 1024;
  options.gather.texelsPerFrame = 20;
  options.causticPhotons = 10000;
  options.causticFrames = 8;
  return options;
}

int nodeOf(const BenchmarkScene& scene, const std::string& name) {
  for (const MeshNode& node : scene.scene.meshNodes)
    if (node.name == name) return node.node;
  return -1;
}

RigidMotion shifted(const glm::dvec3& by) { return {glm::dmat3(1.0), by}; }

/// Root of the mean squared difference over the mean.
double difference(std::span<const glm::vec3> got, std::span<const glm::vec3> expected) {
  double squares = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    squares += std::pow(luminance(glm::dvec3(got[i]) - glm::dvec3(expected[i])), 2.0);
    sum += luminance(glm::dvec3(expected[i]));
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, got.size()));
  return sum > 0.0 ? std::sqrt(squares / count) / (sum / count) : 0.0;
}

class UpdateSuite {
 public:
  UpdateSuite(const Device& device, const LiveOptions& options, SuiteRun& run)
      : device_(device),
        options_(options),
        quiet_(run),
        steps_(run, "bench update", 3 * options.updateCells.size() + options.updateScenes.size()),
        results_(run.results()) {}

  void run() {
    for (const int cells : options_.updateCells) {
      const BenchmarkScene scene = makeMovingRoom(cells);
      const std::string name = fmt::format("{} triangles", scene.compiled.triangleCount());
      gatherTexels(scene, name);
      steps_.advance();
      for (const ChangeDetection detection : {ChangeDetection::Flights, ChangeDetection::Probes}) {
        if (cells > 1) move(scene, name, detection);
        steps_.advance();
      }
    }
    for (const auto& [name, node] : options_.updateScenes) {
      moveOnce(loadBuiltinScene(name), node);
      steps_.advance();
    }
  }

 private:
  void add(const std::string& case_, const std::string& metric, double value, const char* unit,
           double peer = 0.0) {
    results_.push_back({case_, metric, value, unit, peer > 0.0 ? thesisPeer : "",
                        peer > 0.0 ? std::optional<double>(peer / value) : std::nullopt});
  }

  /// Table 14.2: a texel's final gathering by the side of what was drawn for it, beside the thesis'
  /// milliseconds.
  void gatherTexels(const BenchmarkScene& scene, const std::string& name) {
    const std::map<std::uint32_t, std::array<double, 3>> published = {{8, {0.75e-3, 0.90e-3, 1.55e-3}},
                                                                      {16, {0.76e-3, 0.91e-3, 1.57e-3}},
                                                                      {32, {0.78e-3, 0.97e-3, 1.59e-3}}};
    const std::uint32_t triangles = scene.compiled.triangleCount();
    const std::size_t column = triangles < 1000 ? 0 : triangles < 50000 ? 1 : 2;
    LiveLightOptions options = thesisOptions(ChangeDetection::Flights);
    TransportScene transport({scene.compiled, scene.scene.images, scene.scene.lights}, device_);
    LightMapLayoutRequest request;
    request.texels = options.texels;
    const LightMapLayout layout = makeLightMapLayout(scene.scene, scene.compiled, request);
    IrradianceMap map(device_.context(), layout);
    map.set(std::vector<glm::vec3>(layout.texelCount(), glm::vec3(1.0f)));
    const std::size_t count = std::min<std::size_t>(20, layout.texels.size());
    for (const auto& [side, seconds] : published) {
      GatherRequest gather;
      gather.raysPerReceiver = std::min(side * side, 256u);
      FinalGather gatherer(transport, map, gather);
      const std::vector<device::Receiver> receivers =
          gatherReceivers(scene.compiled, std::span(layout.texels).first(count),
                          side * side / gather.raysPerReceiver, gather.raysPerReceiver, 0);
      std::vector<double> taken;
      for (int run = 0; run <= options_.runs; ++run)
        taken.push_back(secondsOf([&] { gatherer.gather(receivers, quiet_); }));
      taken.erase(taken.begin());
      add(name + fmt::format("/{} x {} rays", side, side), "gather",
          median(taken) / static_cast<double>(count), "s", seconds[column]);
    }
  }

#ifdef PRELIGHT_WITH_VIEWER
  /// Nothing where there is no OpenGL.
  std::unique_ptr<LiveDrawing> openDrawing(const BenchmarkScene& scene, const LiveLight& live) const {
    try {
      return std::make_unique<LiveDrawing>(scene, live, options_.updateSide);
    } catch (const Error&) {
      return nullptr;
    }
  }
#endif

  /// The cube and the ball go round for a while, then stand still.
  void move(const BenchmarkScene& scene, const std::string& name, ChangeDetection detection) {
    const std::string case_ = name + (detection == ChangeDetection::Flights ? "/flights" : "/probes");
    const int cube = nodeOf(scene, "Cube"), ball = nodeOf(scene, "Ball");
    LiveLight live(scene.scene, scene.compiled, nullptr, 0.0, thesisOptions(detection),
                   std::array{cube, ball}, device_, quiet_);
    std::map<std::string, std::vector<double>> seconds;
    std::vector<double> frames, again, groups, rays;
#ifdef PRELIGHT_WITH_VIEWER
    const std::unique_ptr<LiveDrawing> drawing = openDrawing(scene, live);
#endif
    for (int f = 1; f <= options_.updateFrames; ++f) {
      const double turn = 2.0 * std::numbers::pi * f / 64.0;
      live.moveNode(cube, shifted({0.2 * std::sin(turn), 0.1 - 0.1 * std::cos(turn), 0.1 * std::sin(turn)}));
      live.moveNode(ball, shifted({0.1 * std::sin(turn), 0.0, 0.2 * std::sin(2.0 * turn)}));
      LiveFrame frame;
      frames.push_back(secondsOf([&] { frame = live.advance(quiet_); }));
#ifdef PRELIGHT_WITH_VIEWER
      if (drawing && f % drawnEvery == 0)
        seconds["drawing"].push_back(secondsOf([&] { drawing->draw(frame, true); }));
#endif
      for (const auto& [stage, s] : frame.stageSeconds) seconds[stage].push_back(s);
      again.push_back(static_cast<double>(frame.photons.traced) /
                      static_cast<double>(live.photons()->pathCount()));
      groups.push_back(static_cast<double>(frame.photons.groups) /
                       static_cast<double>(live.photons()->groupCount()));
      rays.push_back(static_cast<double>(frame.rays()));
    }
    add(case_, "frame", median(frames), "s", thesisFrame);
    for (const char* stage : {"scene", "photons", "density", "gather", "caustics", "drawing"})
      if (seconds.count(stage) > 0) add(case_, stage, median(seconds[stage]), "s");
    add(case_, "photons sent again", median(again), "1");
    add(case_, "groups sent again", median(groups), "1");
    add(case_, "rays", median(rays), "rays");
    settle(live, case_);
  }

  /// An object is moved once: what it touches, what is done about it, and where that leads.
  void moveOnce(const BenchmarkScene& scene, const std::string& node) {
    const glm::dvec3 size(scene.compiled.boundsMax - scene.compiled.boundsMin);
    const RigidMotion motion = shifted({0.03 * size.x, 0.02 * size.y, 0.02 * size.z});
    double changed = 0.0;
    for (const ChangeDetection detection : {ChangeDetection::Flights, ChangeDetection::Probes}) {
      const bool flights = detection == ChangeDetection::Flights;
      const std::string case_ = scene.name + ", " + node + (flights ? "/flights" : "/probes");
      LiveLightOptions options;
      options.detection = detection;
      options.photons = options_.updatePhotons;
      LiveLight live(scene.scene, scene.compiled, nullptr, 0.0, options, {}, device_, quiet_);
      const auto paths = static_cast<double>(live.photons()->pathCount());
      live.moveNode(nodeOf(scene, node), motion);
      double traced = 0.0, groups = 0.0, probes = 0.0;
      for (std::uint32_t f = 0; f <= (flights ? 0 : options.groupSize); ++f) {
        const LiveFrame frame = live.advance(quiet_);
        if (flights) changed = static_cast<double>(frame.photons.changed) / paths;
        traced += static_cast<double>(frame.photons.traced - frame.photons.probes) / paths;
        probes += static_cast<double>(frame.photons.probes) / paths;
        groups +=
            static_cast<double>(frame.photons.groups) / static_cast<double>(live.photons()->groupCount());
      }
      add(case_, "ways that change", changed, "1");
      add(case_, "photons sent again", traced, "1");
      add(case_, "groups sent again", groups, "1");
      add(case_, "probes", probes, "1");
      settle(live, case_);
    }
  }

  void settle(LiveLight& live, const std::string& case_) {
    int frames = 0;
    while (!live.settled() && frames < mostFrames) {
      live.advance(quiet_);
      ++frames;
    }
    const std::vector<glm::vec3> settled(live.indirect().begin(), live.indirect().end());
    add(case_, "settled after", frames, "frames");
    const double seconds = secondsOf([&] { live.recompute(quiet_); });
    add(case_, "difference", difference(settled, live.indirect()), "1");
    add(case_, "all again", seconds, "s");
  }

  const Device& device_;
  const LiveOptions& options_;
  StopOnly quiet_;
  StepCounter steps_;
  std::vector<BenchmarkResult>& results_;
};

}  // namespace

void runUpdate(const Device& device, const LiveOptions& options, SuiteRun& run) {
  UpdateSuite(device, options, run).run();
}

}  // namespace prelight::benchmarks
