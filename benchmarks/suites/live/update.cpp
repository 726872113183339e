#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <numbers>

#include "benchmarks/run/measure.h"
#include "benchmarks/suites/live/live_error.h"
#include "benchmarks/suites/live/live_suite.h"
#include "charts/make_light_map_layout.h"
#include "gi/indirect_light.h"
#include "gi/update/live_light.h"
#include "prelight/error.h"
#include "scene/builtin/gltf_builder.h"
#include "scene/gltf/load/loader.h"

#ifdef PRELIGHT_WITH_VIEWER
#include "benchmarks/suites/live/live_drawing.h"
#endif

namespace prelight::benchmarks {

namespace {

constexpr double bumpHeight = 0.012;  // m
constexpr double bumps = 5.0;         // bumps per side

/// Returns a rectangle with bumps that fade towards its edges, so that walls still meet.
MeshShape makeWall(const glm::dvec3& corner, const glm::dvec3& edgeU, const glm::dvec3& edgeV, int cells) {
  MeshShape wall = makeGrid(corner, edgeU, edgeV, cells, cells);
  if (cells == 1) return wall;
  const glm::dvec3 normal = glm::normalize(glm::cross(edgeU, edgeV));
  const double k = std::numbers::pi * bumps;
  for (std::size_t i = 0; i < wall.positions.size(); ++i) {
    const glm::dvec3 from = glm::dvec3(wall.positions[i]) - corner;
    const double u = glm::dot(from, edgeU) / glm::dot(edgeU, edgeU);
    const double v = glm::dot(from, edgeV) / glm::dot(edgeV, edgeV);
    const double slopeU = bumpHeight * k * std::cos(k * u) * std::sin(k * v);
    const double slopeV = bumpHeight * k * std::sin(k * u) * std::cos(k * v);
    wall.positions[i] += glm::vec3(normal * (bumpHeight * std::sin(k * u) * std::sin(k * v)));
    wall.normals[i] = glm::vec3(glm::normalize(normal - edgeU * (slopeU / glm::dot(edgeU, edgeU)) -
                                               edgeV * (slopeV / glm::dot(edgeV, edgeV))));
  }
  return wall;
}

void addRoom(GltfBuilder& builder, int cells) {
  const int white = builder.addDiffuse("White", {0.73f, 0.73f, 0.73f});
  const int red = builder.addDiffuse("Red", {0.63f, 0.065f, 0.05f});
  const int green = builder.addDiffuse("Green", {0.14f, 0.45f, 0.091f});
  const glm::dvec3 x(2.0, 0.0, 0.0), y(0.0, 2.0, 0.0), z(0.0, 0.0, 2.0), low(-1.0, 0.0, -1.0);
  builder.addObject("Floor", makeWall(low + z, x, -z, cells), white);
  builder.addObject("Ceiling", makeWall(low + y, x, z, cells), white);
  builder.addObject("Back wall", makeWall(low, x, y, cells), white);
  builder.addObject("Left wall", makeWall(low + z, -z, y, cells), red);
  builder.addObject("Right wall", makeWall(low + x, z, y, cells), green);
  builder.addObject("Lamp", makeGrid({-0.24, 1.97, -0.19}, {0.48, 0.0, 0.0}, {0.0, 0.0, 0.38}, 1, 1),
                    builder.addEmitter("Lamp", {17.0f, 12.0f, 4.0f}));
  builder.addCamera("Camera", {0.0, 1.0, 4.0}, {0.0, 1.0, 0.0}, 0.66, 1.0);
}

/// Returns a Cornell box with uneven walls, a cube ("Cube") and a glass ball ("Ball"), like the moving scenes
/// of Larsen (2004, ch. 14). Each wall has cells x cells squares: 36 cells make 13 thousand triangles, 115
/// make 133 thousand. One cell makes the plain box with two cubes, of 34 triangles.
BenchmarkScene makeMovingRoom(int cells) {
  GltfBuilder builder("moving room");
  addRoom(builder, cells);
  const int box = builder.addDiffuse("Cube", {0.73f, 0.73f, 0.73f});
  const bool detailed = cells > 1;
  builder.addObject("Cube", makeBox({0.5, 0.5, 0.5}, detailed ? 4 : 1, true), box, {-0.35f, 0.25f, -0.2f},
                    0.3);
  if (detailed)
    builder.addObject("Ball", makeSphere(0.25f, 32, 20), builder.addGlass("Glass", 1.5f), {0.4f, 0.1f, 0.2f});
  else
    builder.addObject("Other cube", makeBox({0.5, 0.5, 0.5}, 1, false), box, {0.4f, 0.0f, 0.2f}, -0.3);
  Warnings warnings;
  BenchmarkScene made;
  made.name = "moving room";
  const GltfDocument document = builder.take();
  made.scene = loadScene(document, warnings);
  made.compiled = compileScene(made.scene, warnings);
  return made;
}

const char* const thesisPeer = "Larsen 2004";
constexpr double thesisFrame = 1.0 / 35.0;  // s, including drawing
constexpr int drawnEvery = 8;               // draws only every so many frames, since OpenGL may be software
constexpr int mostFrames = 2000;            // largest number of frames until light has settled

/// Returns the setting of Larsen (2004, ch. 14): 77 groups of 40 photons, 140 texels of which 20 per frame
/// are gathered with 32 x 32 rays, and 10 000 photons of caustics over 8 frames.
LiveLightOptions thesisOptions(ChangeDetection detection) {
  LiveLightOptions options;
  options.photons = 3080;
  options.groupSize = 40;
  options.detection = detection;
  options.texels = 140;
  options.gather.rays = 1024;
  options.gather.texelsPerFrame = 20;
  options.causticPhotons = 10000;
  options.causticFrames = 8;
  return options;
}

RigidMotion shifted(const glm::dvec3& by) { return {glm::dmat3(1.0), by}; }

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

  /// Measures Table 14.2: final gathering of a texel by the side of its drawn hemicube, beside the thesis'
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
  /// Returns nullptr without OpenGL.
  std::unique_ptr<LiveDrawing> openDrawing(const BenchmarkScene& scene, const LiveLight& live) const {
    try {
      return std::make_unique<LiveDrawing>(scene, live, options_.updateSide);
    } catch (const Error&) {
      return nullptr;
    }
  }
#endif

  /// Measures frames in which the cube and the ball go round, then stand still.
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

  /// Moves an object once, and measures what that affects, what is computed again, and the remaining
  /// difference.
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
    add(case_, "difference", relativeError(settled, live.indirect()), "1");
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
