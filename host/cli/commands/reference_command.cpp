#include "integrators/exposure.h"
#include "integrators/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <numbers>
#include <utility>

#include "cli/commands.h"
#include "cli/commands/denoiser_report.h"
#include "cli/commands/exposure.h"
#include "cli/commands/planned_picture.h"
#include "cli/division/division_options.h"
#include "cli/division/stages.h"
#include "cli/options/light_option.h"
#include "cli/options/object_option.h"
#include "cli/options/options.h"
#include "cli/options/scene_options.h"
#include "cli/options/sky_option.h"
#include "cli/options/values.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/session.h"
#include "io/finite_results.h"
#include "io/plan_json.h"
#include "pictures/picture_denoising.h"
#include "pictures/picture_lights.h"
#include "pictures/picture_request.h"
#include "pictures/picture_sky.h"
#include "pictures/placed_objects.h"
#include "pictures/session/darkness.h"
#include "prelight/picture.h"
#include "scene/pose.h"
#include "viewer/core/camera.h"

namespace prelight::cli {
namespace {

using reference::Film;
using reference::ReferenceReport;
using reference::ReferenceRequest;

constexpr int referenceHeight = 720;

struct ReferenceCommand {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::filesystem::path environment;
  double skyRotationDegrees = 0.0;
  std::optional<int> camera;
  PictureSize size{std::nullopt, referenceHeight};
  std::optional<std::vector<Light>> lights;
  ReferenceRequest request;
  bool resume = false;
  bool dryRun = false;
  Division division;
  LoadOptions load;
  std::vector<PlacedObject> objects;
};

/// A finished picture and how it was made.
struct ReferenceRun {
  ReferenceRequest request;
  Film film;
  ReferenceReport report;
  DeviceInfo device;
};

std::string effortText(const ReferenceRequest& request) {
  if (request.error) return fmt::format("--error {}", *request.error);
  if (request.seconds) return fmt::format("--time {}", *request.seconds);
  return fmt::format("--spp {}", request.samples);
}

std::uint64_t samplesTaken(const ReferenceRun& run) {
  return run.film.passes * reference::samplesPerPass(run.request);
}

nlohmann::ordered_json referenceReport(const ReferenceCommand& command, const ReferenceRun& run,
                                       Session& session) {
  const double seconds = run.report.seconds;
  nlohmann::ordered_json report = reportOf(
      "reference", {{"scene", command.scene.string()},
                    {"output", command.output.string()},
                    {"integrator", reference::integratorName(run.request.integrator)},
                    {"depth", run.request.depth},
                    {"effort", effortText(run.request)},
                    {"seed", run.request.seed},
                    {"width", run.request.width},
                    {"height", run.request.height},
                    {"spp", samplesTaken(run)},
                    {"passes", run.film.passes},
                    {"error", run.film.passes < 2 ? nlohmann::ordered_json(nullptr)
                                                  : nlohmann::ordered_json(run.film.relativeError())},
                    {"rays", run.report.rays},
                    {"raysPerSecond", seconds > 0.0 ? static_cast<double>(run.report.rays) / seconds : 0.0},
                    {"seconds", session.times().total()},
                    {"stages", toJson(session.times())},
                    {"device", toJson(run.device)},
                    {"plan", toJson(run.report.plan)},
                    {"notes", run.report.notes},
                    {"warnings", session.warnings()}});
  return report;
}

void printReference(const ReferenceCommand& command, const ReferenceRun& run, Session& session) {
  const Console& console = session.console();
  console.line("device", run.device.name);
  const double seconds = run.report.seconds;
  console.line(
      "traced",
      fmt::format("{} samples per pixel, {} rays{}", samplesTaken(run),
                  shortCount(static_cast<double>(run.report.rays)),
                  seconds > 0.0 ? fmt::format(", {} per second",
                                              shortCount(static_cast<double>(run.report.rays) / seconds))
                                : ""));
  if (run.film.passes >= 2)
    console.line("error", fmt::format("{:.4f} of the mean (rms standard error of a pixel's luminance)",
                                      run.film.relativeError()));
  if (console.detailsWanted()) {
    for (const auto& [stage, time] : session.times().stages())
      console.line("", fmt::format("{:<12}{:8.3f} s", stage, time));
    for (const PlannedPass& pass : run.report.plan)
      console.line(pass.runs ? "runs" : "skipped", fmt::format("{}: {}", pass.name, pass.reason));
  }
  console.line("wrote",
               fmt::format("{}: {}x{}, {} integrator, in {}", command.output.string(), run.request.width,
                           run.request.height, reference::integratorName(run.request.integrator),
                           shortSeconds(session.times().total())));
}

/// Returns the layers besides the picture. There is no variance with one sample per pixel.
std::vector<PictureChannel> layersOf(const Film& film) {
  std::vector<PictureChannel> layers;
  addLayers(film.partPictures(), layers);
  if (std::vector<float> variance = film.variance(); !variance.empty())
    layers.push_back({"variance.Y", std::move(variance)});
  return layers;
}

void writeFilm(const ReferenceCommand& command, const ReferenceRun& run, const Picture& picture,
               Session& session) {
  const std::vector<PictureChannel> channels = layersOf(run.film);
  if (run.film.passes < 2)
    session.console().note("one sample per pixel gives no variance: the picture has no channel variance.Y");
  requireFinite(command.output, picture);
  writePicture(command.output, picture, channels);
}

/// Traces a picture and keeps its progress in `state`, at intervals and when the user stops it.
void traceResumably(const reference::ReferenceInputs& inputs, const Device& device, KeptState& state,
                    ReferenceRun& run, Session& session) {
  const StateKey key = reference::filmKey(inputs, run.request, run.device);
  try {
    reference::renderReference(inputs, run.request, device, state.begin(key, session.progress()), run.film,
                               run.report);
  } catch (const Interrupted&) {
    session.progress().clear();
    throw Interrupted(state.message());
  }
}

/// A picture with a given number of passes, and its cost.
struct ReferenceSample {
  WorkSample sample;
  ReferenceRun run;
};

ReferenceSample drawSample(const reference::ReferenceInputs& inputs, const ReferenceRequest& asked,
                           std::uint64_t passes, const Device& device, Session& session) {
  ReferenceSample drawn;
  ReferenceRequest& request = drawn.run.request = asked;
  request.samplesPerPass = reference::samplesPerPass(asked);
  request.samples = passes * request.samplesPerPass;
  request.error.reset();
  request.seconds.reset();
  drawn.run.film = Film(request.width, request.height, request.parts);
  drawn.sample.size = static_cast<double>(request.samples);
  drawn.sample.work = measureWork([&] {
    reference::renderReference(inputs, request, device, session.progress(), drawn.run.film, drawn.run.report);
  });
  session.progress().clear();
  return drawn;
}

/// Returns the samples per pixel that the picture will end with; the error falls with the square root of
/// their number.
double samplesAimedAt(const ReferenceRequest& request, const ReferenceSample& drawn) {
  if (!request.error) return static_cast<double>(request.samples);
  const double factor = drawn.run.film.relativeError() / *request.error;
  return drawn.sample.size * std::max(1.0, factor * factor);
}

/// Returns the passes of the second sample: about as many as take a few seconds, at most a quarter of all.
std::uint64_t passesOfSecond(const ReferenceSample& first, const ReferenceRequest& request) {
  constexpr double seconds = 2.0;
  const double affordable = seconds / std::max(first.sample.work.seconds, 1e-3);
  const double all = static_cast<double>(request.samples) / first.sample.size;
  const double most = request.error || request.seconds ? affordable : all / 4.0;
  return static_cast<std::uint64_t>(std::clamp(affordable, 2.0, std::max(2.0, most)));
}

PlannedPicture planReference(const reference::ReferenceInputs& inputs, const ReferenceCommand& command,
                             const ReferenceRequest& request, const Device& device, Session& session) {
  const Work before = workSoFar(session.times().total());
  const ReferenceSample first = drawSample(inputs, request, 1, device, session);  // loads kernels
  const ReferenceSample one = drawSample(inputs, request, 1, device, session);
  const ReferenceSample more = drawSample(inputs, request, passesOfSecond(one, request), device, session);
  PlannedPicture planned{.output = command.output, .width = request.width, .height = request.height};
  planned.device = device.info();
  planned.plan = more.run.report.plan;
  planned.bytes = encodedBytes(command.output, more.run.film.picture(), layersOf(more.run.film));
  planned.how =
      fmt::format("{} integrator, {}", reference::integratorName(request.integrator), effortText(request));
  if (request.seconds) {
    planned.time = fmt::format("{} on {}, as asked for", shortSeconds(*request.seconds), planned.device.name);
    return planned;
  }
  const double samples = samplesAimedAt(request, more);
  planned.estimate = extrapolate(one.sample, more.sample, samples, planned.device);
  addOnce(before, first.sample.work, one.sample.work, *planned.estimate);
  planned.time = fmt::format("from {:g} of {}{:.0f} samples per pixel", more.sample.size,
                             request.error ? "about " : "", samples);
  return planned;
}

void tellPlan(const reference::ReferenceInputs& inputs, const ReferenceCommand& command,
              const ReferenceRequest& request, const Device& device, Session& session) {
  const PlannedPicture planned = planReference(inputs, command, request, device, session);
  printPlannedPicture(session.console(), planned);
  nlohmann::ordered_json report = reportOf("reference", {{"scene", command.scene.string()}});
  addPlannedPicture(planned, report);
  report["warnings"] = session.warnings();
  session.console().json(report);
}

constexpr double leastAperture = 1e-9, greatestAperture = 1e6;  // m, or f-numbers

/// Reads an aperture, "0.02" (m) or "f/2.8".
void setAperture(const std::string& text, reference::Lens& lens) {
  const bool isNumber = text.starts_with("f/");
  (isNumber ? lens.fNumber : lens.aperture) =
      parseRealNumber("--aperture", isNumber ? text.substr(2) : text, {leastAperture, greatestAperture},
                      isNumber ? "" : " (m), or f/NUMBER");
}

/// Poses the scene as it is when the shutter opens: at its moment, or at the start of its first animation.
void openShutter(LoadedScene& loaded) {
  if (loaded.scene.animations.empty())
    throw UsageError("--shutter", "the scene has no animation that moves something", "leave it out");
  if (loaded.scene.moment) return;
  setPose(loaded.scene, 0, 0.0);
  Warnings said;  // these warnings were given for the scene at rest
  loaded.compiled = compileScene(loaded.scene, said);
}

/// Returns the index of the scene's camera that a picture looks through; none: a framed one.
std::optional<std::size_t> cameraOf(const Scene& scene, std::optional<int> asked) {
  if (scene.cameras.empty()) return std::nullopt;
  return static_cast<std::size_t>(asked.value_or(0));
}

/// Has each pass show a moment of its own if a shutter is open. Returns the exposure, which must live as long
/// as the inputs.
std::unique_ptr<reference::Exposure> expose(const ReferenceCommand& command, const LoadedScene& loaded,
                                            bool lightsGiven, reference::ReferenceInputs& inputs) {
  if (command.request.shutter <= 0.0) return nullptr;
  const reference::StillParts still{lightsGiven, cameraOf(loaded.scene, command.camera)};
  auto exposure = std::make_unique<reference::Exposure>(loaded.scene, inputs, still, command.request);
  inputs.ofPass = [shown = exposure.get()](std::uint64_t pass) -> const reference::ReferenceInputs& {
    return shown->ofPass(pass);
  };
  inputs.motion = exposure->motion();
  return exposure;
}

void requireDivisible(const ReferenceCommand& command) {
  requireDivisible(command.division, command.request.seconds ? "--time" : "",
                   "a picture that ends by the clock is not the same in every process");
  requireDivisible(command.division, command.request.error ? "--error" : "",
                   "the number of samples that it takes is not known before they are added up");
}

/// Returns the scene as it is when the shutter opens, with the objects that are put into it.
LoadedScene loadScene(const ReferenceCommand& command, Session& session) {
  checkMoment(command.load);
  LoadedScene loaded = session.load(command.scene, command.load);
  requireTriangles(loaded);
  if (command.request.shutter > 0.0) openShutter(loaded);
  if (command.objects.empty()) return loaded;
  pictures::addObjects(session, command.objects, loaded.scene);
  Warnings said;  // these warnings were given for the scene without the lights
  loaded.compiled = compileScene(loaded.scene, said);
  return loaded;
}

void runReference(const ReferenceCommand& command, Context& context) {
  requireDivisible(command);
  Session session(context);
  LoadedScene loaded = loadScene(command, session);
  std::optional<std::vector<Light>> lights = command.lights;
  pictures::makeSurfaces(lights, loaded);
  const auto [sky, studio, name, turn] = pictures::choosePictureSky(
      session, command.environment, command.lights.has_value(), false, loaded, command.camera);
  if (!command.camera) pictures::frameScene(session, studio, command.size.width, command.size.height, loaded);
  checkDividedOutput(command.division, command.output, {".exr"});

  pictures::PictureDenoising denoising(command.request.guides);
  reference::ReferenceInputs inputs{loaded.compiled,
                                    loaded.scene.images,
                                    lights.value_or(loaded.scene.lights),
                                    viewer::chooseCamera(loaded.scene, loaded.compiled, command.camera),
                                    sky ? &*sky : nullptr,
                                    command.skyRotationDegrees * std::numbers::pi / 180.0 + turn};
  const std::unique_ptr<reference::Exposure> exposure = expose(command, loaded, lights.has_value(), inputs);
  ReferenceRun run;
  run.request = command.request;
  run.request.parts = true;
  run.request.height = command.size.height;
  run.request.width = command.size.width.value_or(pictureWidth(inputs.camera, command.size.height));
  run.film = Film(run.request.width, run.request.height, run.request.parts);
  session.console().line("scene", fmt::format("{}: {}", command.scene.string(), sceneText(loaded)));
  const Device device =
      session.times().measure("device", [&] { return Device::open(session.deviceOptions()); });
  run.device = device.info();
  denoising.require();
  if (command.dryRun) return tellPlan(inputs, command, run.request, device, session);
  if (command.division.listsStages) run.request.samples = 1;
  const StopSignals::SafePoints safePoints(context.signals);
  KeptState state(command.output, "reference", command.resume, command.division, session.console(),
                  context.signals);
  const auto trace = [&] {
    session.times().measure("trace", [&] { traceResumably(inputs, device, state, run, session); });
  };
  if (!doStages(session, "reference", state, trace)) return;
  Picture picture = run.film.picture();
  denoising.apply(session, run.report.guides, DenoiseEffort::Full, picture);
  session.progress().clear();
  session.times().measure("write", [&] { writeFilm(command, run, picture, session); });
  state.remove();
  pictures::warnOfDarkness(session, picture, loaded, inputs.camera,
                           {inputs.lights, inputs.sky, !command.lights});
  for (const std::string& note : run.report.notes) session.console().note(note);
  printDenoiser(session.console(), denoising);
  printReference(command, run, session);
  nlohmann::ordered_json report = referenceReport(command, run, session);
  addDenoiser(report, denoising);
  addLook(report, studio, std::nullopt);
  session.console().json(report);
}

void addPathOptions(CLI::App& app, ReferenceCommand& command) {
  ReferenceRequest& request = command.request;
  for (const char* name : {"integrator", "light-paths", "depth"}) addOption(app, name, request);
  CLI::Option* samples = addOption(app, "spp", request);
  CLI::Option* error = addOption(app, "error", request);
  CLI::Option* time = addOption(app, "time", request);
  samples->excludes(error)->excludes(time);
  error->excludes(time);
  addSeedOption(app, request.seed);
  addOption(app, "denoise", request);
  CLI::Option* aperture =
      addOwnOption(app, optionNamed<ReferenceRequest>("aperture"), "M|f/N",
                   [&request](const std::string& text) { setAperture(text, request.lens); });
  addOption(app, "focus", request)->needs(aperture);
  addOption(app, "shutter", request);
}

void addViewOptions(CLI::App& app, ReferenceCommand& command) {
  const auto addPictureOption = [&](const char* name, const std::function<void(double)>& store) {
    addOption(app, optionNamed<pictures::PictureRequest>(name), std::nullopt, store);
  };
  addPictureOption("camera", [&](double index) { command.camera = static_cast<int>(index); });
  addPictureSize(
      app, "--size", [&](PictureSize size) { command.size = size; },
      fmt::format("pixels; one number is the height (default {})", referenceHeight));
  addSkyOption(app, command.environment, "sky");
  addPictureOption("rotate-env", [&](double degrees) { command.skyRotationDegrees = degrees; });
  addLightOption(app, command.lights);
}

}  // namespace

void addReferenceCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<ReferenceCommand>();
  CLI::App* app = program.add_subcommand("reference", "Trace a reference picture to measure others against");
  app->add_option("SCENE", command->scene, "glTF file (.gltf or .glb)")->required()->type_name("");
  app->add_option("-o,--output", command->output, "picture to write (.exr): linear radiance, and variance.Y")
      ->required()
      ->type_name("IMG.exr");
  addPathOptions(*app, *command);
  app->add_flag("--resume", command->resume, "continue an interrupted picture (IMG.exr.state)");
  app->add_flag("--dry-run", command->dryRun,
                "write nothing; say what would be drawn, how large the file would be, and how long it would "
                "take, estimated from a few samples")
      ->excludes("--resume");
  addDivisionOptions(*app, command->division);
  addSceneOptions(*app, command->load);
  addMomentOptions(*app, command->load);
  addObjectOption(*app, command->objects, "put another glTF file into the scene");
  addViewOptions(*app, *command);
  app->footer(
      "Examples:\n"
      "  prelight reference cornell.glb -o truth.exr --spp 1024 --size 256\n"
      "  prelight reference level.glb -o truth.exr --error 0.01 --env sky.hdr --depth 8\n"
      "  prelight reference level.glb -o truth.exr --error 0.01 --dry-run\n"
      "  prelight reference level.glb -o quick.exr --spp 16 --denoise\n"
      "  prelight reference rooms.glb -o truth.exr --object ball.glb:-1,0.5,1\n"
      "  prelight reference level.glb -o 2.part --spp 4096 --slice 2/16");
  app->callback([command, app, &context] {
    command->division.arguments = recordedArguments(*app);
    runReference(*command, context);
  });
}

}  // namespace prelight::cli
