#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "bake/animated_bake.h"
#include "base/atomic_file.h"
#include "cli/commands.h"
#include "cli/commands/bake_estimate.h"
#include "cli/commands/export_command.h"
#include "cli/commands/planned_bake.h"
#include "cli/division/division_options.h"
#include "cli/division/stages.h"
#include "cli/options/bake_options.h"
#include "cli/options/option_names.h"
#include "cli/options/options.h"
#include "cli/options/scene_options.h"
#include "cli/options/sky_option.h"
#include "cli/options/values.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/session.h"
#include "cli/waiting_data.h"
#include "cli/work_estimate.h"
#include "compress/stored_forms.h"
#include "io/baked_file.h"
#include "io/finite_results.h"
#include "library/save.h"
#include "pictures/named_sky.h"
#include "plan/check_request.h"
#include "prelight/picture.h"
#include "refine/coarse_triangles.h"
#include "refine/refine_meshes.h"
#include "scene/deform.h"
#include "scene/dropped_features.h"
#include "scene/gltf/gltf_document.h"
#include "scene/pose.h"
#include "techniques/light_map/light_map_file.h"

namespace prelight::cli {
namespace {

struct BakeCommand {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::filesystem::path report;
  std::filesystem::path environment;
  ExportAfterBake exported;
  bool resume = false;
  bool dryRun = false;
  Division division;
  LoadOptions load;
  std::string animation;  ///< name or number; empty: none
  std::optional<int> keyCount;
  KeyRequest keys;
  BakeSettings bake;
};

void checkBakeOutputs(const BakeCommand& command) {
  checkDividedOutput(command.division, command.output, {".glb"});
  if (command.bake.request.lightMap && !command.division.slice)
    checkOutputFile("-o", lightMapPath(command.output), {".exr"});
  if (!command.report.empty()) checkOutputFile("--report", command.report, {".json"});
  if (!command.bake.dumpKernels.empty()) checkOutputFolder("--dump-kernels", command.bake.dumpKernels);
}

void checkAnimationOptions(const BakeCommand& command, const BakeRequest& request) {
  if (command.load.at) {
    if (command.keyCount || command.keys.error)
      throw UsageError("--at", "keys are baked at moments of their own",
                       "leave out --at, or --keys and --key-error");
    return;
  }
  if (command.animation.empty()) {
    if (command.keyCount || command.keys.error)
      throw UsageError(command.keyCount ? "--keys" : "--key-error",
                       "keys need an animation, and none is named", "add --animation NAME|INDEX");
    return;
  }
  if (request.visibility != Visibility::Rays)
    throw UsageError("--animation", "keys are baked by rays", "leave out --visibility");
  if (request.sh.order == 0)
    throw UsageError("--animation", "keys hold SH transfer, which is not asked for", "add --sh N");
  if (request.chartTransfer.size > 0)
    throw UsageError("--animation", "keys have no light maps", "leave out --texels");
}

/// Returns the request, with the default techniques if it names none.
BakeRequest withTechniques(const BakeCommand& command) {
  BakeRequest request = command.bake.request;
  if (!command.bake.techniqueGiven()) useDefaultTechniques(request);
  return request;
}

BakeRequest requestOf(const BakeCommand& command, Session& session) {
  BakeRequest request = withTechniques(command);
  if (!command.bake.techniqueGiven())
    session.console().note(fmt::format("no technique named, baking {}", techniqueText(request)));
  if (request.bounces > 0 && !request.carriesLight()) {
    session.warn("--bounces: ignored, since ambient occlusion has no bounces; add a transfer such as --sh N");
    request.bounces = 0;
  }
  const FileCompression& compression = command.bake.compression;
  if (compression.transfer && request.sh.order == 0)
    throw UsageError("--compress", "this method compresses SH transfer, which is not asked for",
                     "add --sh N, or use --compress auto, which makes everything small");
  if (compression.occluders && !request.occluders)
    throw UsageError("--vo-compress", "it compresses vector occluders, which are not asked for", "add --vo");
  checkAnimationOptions(command, request);
  return request;
}

/// Reads the sky that radiosity and light maps are baked under; no other technique depends on one.
void readSky(const BakeCommand& command, const LoadedScene& loaded, Session& session, BakeRequest& request) {
  if (command.environment.empty() && (request.radiosity || request.lightMap))
    request.radiosity.environment = loaded.sky;
  if (command.environment.empty()) return;
  const Environment sky = pictures::readNamedSky(command.environment);
  if (request.radiosity || request.lightMap)
    request.radiosity.environment = std::make_shared<const Environment>(sky);
  else
    session.warn("--env: the transfer holds for every sky; give the map to render or view instead");
}

/// Returns the animation to bake, if there is one. Throws UsageError if --animation names none of the scene.
std::optional<std::size_t> animationOf(Session& session, const BakeCommand& command, const Scene& scene) {
  if (command.load.at) return std::nullopt;
  if (!command.animation.empty()) return findAnimation(scene, command.animation);
  if (!scene.animations.empty() && !scene.moment)
    session.console().note(fmt::format(
        "the scene has {} animation{}; the rest pose is baked (--at bakes a moment, --animation keys)",
        scene.animations.size(), scene.animations.size() == 1 ? "" : "s"));
  return std::nullopt;
}

void bakeKeys(Session& session, const BakeCommand& command, const LoadedScene& loaded,
              const BakeRequest& request, const DeviceOptions& deviceOptions, std::size_t animation,
              Progress& progress, BakeRun& run) {
  AnimationReport report;
  session.times().measure("animation", [&] {
    run.bake.animation = bakeAnimation(loaded.scene, loaded.compiled, animation, request, command.keys,
                                       run.bake, Device::open(deviceOptions), progress, report);
  });
  session.progress().clear();
  run.bake.info.rays += report.rays;
  const AnimatedTransfer& keys = *run.bake.animation;
  std::string text = fmt::format("{} key{} from {:g} s to {:g} s, {} poses baked, {} equal to others",
                                 keys.times.size(), keys.times.size() == 1 ? "" : "s", keys.times.front(),
                                 keys.times.back(), report.bakes, report.reused);
  if (command.keys.error) text += fmt::format(", error {:.3g} between them", report.error);
  session.console().line("animation", text);
  run.report.notes.push_back("animation: " + text);
  for (const std::string& note : report.notes) {
    session.console().note(note);
    run.report.notes.push_back(note);
  }
}

/// Returns the record of the sky that was baked under, if the scene's file does not hold that sky itself.
std::optional<BakedSky> bakedSky(const BakeCommand& command, const BakeRequest& request) {
  const auto& sky = request.radiosity.environment;
  if (command.environment.empty() || sky == nullptr) return std::nullopt;
  return pictures::recordOf(command.environment, *sky, request.radiosity.skyRotation, command.output);
}

/// Embeds everything baked in the document, which becomes the one that is written. Adds what that saves to
/// the report.
void embedAll(const BakeCommand& command, const StoredForms& forms, LoadedScene& loaded, BakeRun& run) {
  GltfDocument& document = ownDocument(loaded);
  for (const std::string& text : savingsTexts(embedBake(document, loaded.compiled, run.bake, &forms)))
    run.report.notes.push_back(text);
  if (run.bake.lightMap)
    embedLightMap(document, loaded.compiled, run.bake.lightMap->layout,
                  lightMapPath(command.output).filename().string());
}

/// Adds all outputs of a bake but its report. The picture comes before the file that refers to it.
void addOutputs(const BakeCommand& command, const StoredForms& forms, LoadedScene& loaded, BakeRun& run,
                OutputFiles& files) {
  if (run.bake.lightMap) {
    const std::filesystem::path picture = lightMapPath(command.output);
    requireFiniteLightMap(picture, *run.bake.lightMap);
    addLightMap(files, picture, *run.bake.lightMap);
  }
  embedAll(command, forms, loaded, run);
  addGlb(files, command.output, *loaded.document);
}

/// Writes all outputs, which come into their places only when every one, the report included, is complete.
/// Returns the report.
nlohmann::ordered_json writeOutputs(const BakeCommand& command, const BakeRequest& request,
                                    const StoredForms& forms, LoadedScene& loaded, BakeRun& run,
                                    Session& session) {
  OutputFiles files;
  session.times().measureProcessor("write", [&] {
    session.times().measure("write", [&] { addOutputs(command, forms, loaded, run, files); });
  });
  nlohmann::ordered_json report = bakeReport("bake", loaded, command.output, request, run, session);
  if (!command.report.empty()) {
    const std::string text =
        withOptions(report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) + "\n";
    files.add(command.report, std::as_bytes(std::span(text)));
  }
  const StopSignals::Writing writing(session.signals());
  files.commit();
  return report;
}

/// Frees the meshes unless poses or charts need them; everything else is made from the compiled scene.
void dropUnusedMeshes(const BakeRequest& request, bool animated, Scene& scene) {
  if (!animated && !request.lightMap && request.chartTransfer.size == 0) scene.meshes = std::vector<Mesh>();
}

/// Warns of material features that a technique ignores: light maps and specular transport follow rays,
/// ambient occlusion knows no materials, and vector occluders treat glass in their own way.
void warnOfDroppedFeatures(Session& session, const LoadedScene& loaded, const BakeRequest& request) {
  Warnings dropped;
  if ((request.carriesLight() && !request.specular) || request.radiosity)
    noteDroppedFeatures(loaded.scene, loaded.compiled, MaterialPath::Transfer, "baked transfer", dropped);
  for (const std::string& warning : dropped) session.warn(warning);
}

/// Compresses what was baked, and returns the forms in which it is stored.
StoredForms compressBaked(Session& session, const BakeCommand& command, const CompiledScene& scene,
                          const Progress& progress, BakeRun& run) {
  StoredForms forms;
  if (command.bake.compression.any())
    session.times().measure("compress", [&] {
      forms = compressBake(command.bake.compression, scene, run.bake, run.report.notes, progress);
    });
  return forms;
}

/// Says what a bake would do, write and cost, and writes nothing.
void tellPlan(const BakeCommand& command, const BakeRequest& request, const DeviceOptions& deviceOptions,
              bool animated, LoadedScene& loaded, Session& session) {
  const Work loading = workSoFar(session.times().total());
  BakeEstimate estimate = estimateBake(session, loaded, request, deviceOptions);
  const StoredForms forms =
      compressBaked(session, command, loaded.compiled, session.progress(), estimate.sample);
  embedAll(command, forms, loaded, estimate.sample);
  if (estimate.seconds) *estimate.seconds += loading.seconds;
  if (estimate.processorSeconds) *estimate.processorSeconds += loading.processor;
  if (animated) {
    estimate.seconds.reset();
    estimate.processorSeconds.reset();
  }
  const PlannedBake planned{command.output, request, glbSize(*loaded.document), animated};
  printPlannedBake(session.console(), planned, estimate);
  session.console().json(plannedBakeReport(planned, estimate, loaded, session));
}

/// The results of a bake, and the forms in which they are stored.
struct BakedScene {
  BakeRun run;
  StoredForms forms;
};

BakedScene bakeAll(const BakeCommand& command, const LoadedScene& loaded, const BakeRequest& request,
                   const DeviceOptions& deviceOptions, std::optional<std::size_t> animation, Session& session,
                   KeptState& state) {
  try {
    const StateKey key = animation ? keysKey(*animation, command.keys) : StateKey();
    BakedScene baked{session.bake(loaded, request, deviceOptions, &state, key), {}};
    if (animation)
      bakeKeys(session, command, loaded, request, deviceOptions, *animation, state.progress(), baked.run);
    baked.forms = compressBaked(session, command, loaded.compiled, state.progress(), baked.run);
    return baked;
  } catch (const Interrupted&) {
    throw Interrupted(state.message());
  }
}

/// Refines the scene if that is asked for, and returns what was done; else warns of large triangles.
std::optional<RefineReport> refineAsAsked(const BakeCommand& command, const BakeRequest& request,
                                          const DeviceOptions& deviceOptions, Session& session,
                                          LoadedScene& loaded) {
  if (!command.bake.refine) {
    if (staysAtVertices(request, {}))
      if (const auto warning = coarseWarning(loaded.path, loaded.compiled)) session.warn(*warning);
    return std::nullopt;
  }
  RefinedScene refined = session.refine(std::move(loaded), command.bake.refine, deviceOptions);
  loaded = std::move(refined.scene);
  return refined.report;
}

/// Rays per vertex of a bake whose stages are listed.
constexpr std::uint64_t raysOfListedStages = 64;

void runBake(const BakeCommand& command, Context& context) {
  checkRequest(command.bake.request);
  requireUse(withTechniques(command));
  requireDivisible(command.division, command.bake.request.effort.seconds ? "--time" : "",
                   "a bake that ends by the clock is not the same in every process");
  Session session(context);
  LoadOptions load = command.load;
  if (load.at) load.animation = command.animation;
  LoadedScene loaded = session.load(command.scene, load);
  requireTriangles(loaded);
  checkBakeOutputs(command);
  checkExport(command.exported);
  BakeRequest request = requestOf(command, session);
  readSky(command, loaded, session, request);
  warnOfDroppedFeatures(session, loaded, request);
  const std::optional<std::size_t> animation = animationOf(session, command, loaded.scene);

  DeviceOptions deviceOptions = session.deviceOptions();
  command.bake.addTo(deviceOptions);
  session.console().line("scene", fmt::format("{}: {}", command.scene.string(), sceneText(loaded)));
  const std::optional<RefineReport> refined = refineAsAsked(command, request, deviceOptions, session, loaded);
  loaded = session.withCharts(std::move(loaded), request);
  dropUnusedMeshes(request, animation.has_value(), loaded.scene);
  const StopSignals::SafePoints safePoints(context.signals);
  if (command.dryRun) {
    tellPlan(command, request, deviceOptions, animation.has_value(), loaded, session);
    return;
  }
  if (command.division.listsStages) request.effort.rays = std::min(request.effort.rays, raysOfListedStages);
  WaitingData data(request, ownDocument(loaded));
  KeptState state(command.output, "bake", command.resume, command.division, session.console(),
                  context.signals);
  BakedScene baked;
  const auto bake = [&] {
    baked = bakeAll(command, loaded, request, deviceOptions, animation, session, state);
  };
  if (!doStages(session, "bake", state, bake)) return;
  BakeRun& run = baked.run;
  for (const std::string& warning : run.report.warnings) session.warn(warning);
  run.bake.info.sky = bakedSky(command, request);
  run.bake.info.refined = loaded.refined;
  if (refined) run.report.notes.push_back("refined: " + textOf(*refined));
  data.fetch();
  nlohmann::ordered_json report = writeOutputs(command, request, baked.forms, loaded, run, session);
  printBakeSummary(session.console(), request, run, session.times());
  session.console().line(
      "wrote", fmt::format("{} in {}", command.output.string(), shortSeconds(session.times().total())));
  if (!command.exported.output.empty())
    report["export"] = exportBaked(command.output, command.exported, session);
  state.remove();
  session.console().json(report);
}

void addAnimationOptions(CLI::App& app, BakeCommand& command) {
  app.add_option("--animation", command.animation,
                 "bake the SH transfer at several moments of this animation, too; with --at, the animation "
                 "that the moment belongs to")
      ->type_name("NAME|INDEX");
  addMomentOption(app, command.load);
  const auto add = [&](const char* name, const std::function<void(double)>& store) {
    const Option<AnimationKeys>& row = optionNamed<AnimationKeys>(name);
    return addOption(app, row, row.usualValue(), store);
  };
  CLI::Option* keys = add("keys", [&command](double count) {
    command.keyCount = static_cast<int>(count);
    command.keys.count = static_cast<int>(count);
  });
  add("key-error", [&command](double value) { command.keys.error = value; })->excludes(keys);
}

}  // namespace

void addBakeCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<BakeCommand>();
  CLI::App* app =
      program.add_subcommand("bake", "Precompute a scene's light transport and store it in a .glb");
  app->add_option("SCENE", command->scene, "glTF file (.gltf or .glb)")->required()->type_name("");
  app->add_option("-o,--output", command->output, "baked file to write (.glb)")
      ->required()
      ->type_name("OUT.glb");
  addTechniqueOptions(*app, command->bake);
  addRefineOptions(*app, command->bake);
  app->add_flag("--vo-compress", command->bake.compression.occluders,
                "store vector occluders as whole numbers, in about a quarter of the bytes");
  addMapPhotonOptions(*app, command->bake.request);
  addEffortOptions(*app, command->bake);
  addSceneOptions(*app, command->load);
  addAnimationOptions(*app, *command);
  addSkyOption(*app, command->environment, optionNamed<BakeRequest>("sky").help);
  app->add_option("--report", command->report, "write a report of the bake as JSON")->type_name("FILE.json");
  app->add_option("--export", command->exported.output,
                  "export the bake, too, as `prelight export` does, into a folder or one .glb")
      ->type_name("DIR|FILE.glb");
  app->add_option("--export-target", command->exported.target, "target of --export, as for `prelight export`")
      ->type_name("TARGET");
  app->add_flag("--resume", command->resume,
                "continue an interrupted bake of the same scene with the same options (OUT.glb.state)");
  app->add_flag("--dry-run", command->dryRun,
                "write nothing; say what would be done and skipped and why, how large the file would be, and "
                "how long the bake would take, estimated from a few rays")
      ->excludes("--resume");
  addDivisionOptions(*app, command->division);
  addKernelOptions(*app, command->bake);
  app->footer(
      "Without a technique the bake is --ao --sh 3 --bounces 1.\n\n"
      "Examples:\n"
      "  prelight bake level.glb -o baked.glb --ao --sh 4 --bounces 2\n"
      "  prelight bake level.glb -o baked.glb --sh 4 --bounces 2 --dry-run\n"
      "  prelight bake level.glb -o baked.glb --ao --error 0.01 --report report.json\n"
      "  prelight bake level.glb -o baked.glb --sh 6 --haar 32 --bounces 2 --compress cpca:64:8\n"
      "  prelight bake house.glb -o baked.glb --sh 4 --refine 0.01 --bounces 2\n"
      "  prelight bake house.glb -o baked.glb --sh 4 --texels 512 --bounces 2\n"
      "  prelight bake aquarium.glb -o baked.glb --sh 5 --bounces 2 --specular-transport\n"
      "  prelight bake house.glb -o baked.glb --lightmap --texel-size 0.05\n"
      "  prelight bake house.glb -o baked.glb --lightmap --texel-error 0.02\n"
      "  prelight bake house.glb -o baked.glb --lightmap --rays 256 --denoise\n"
      "  prelight bake house.glb -o baked.glb --lightmap --export web --export-target three\n"
      "  prelight bake glass.glb -o baked.glb --lightmap --caustics --photons 1000000\n"
      "  prelight bake swing.glb -o baked.glb --sh 4 --animation 0 --key-error 0.05\n"
      "  prelight bake room.glb -o baked.glb --light-groups --light-group lamps=Lamp* --bounces 3\n"
      "  prelight bake city.glb -o 2.part --sh 4 --rays 4096 --slice 2/16");
  app->callback([command, app, &context] {
    command->division.arguments = recordedArguments(*app);
    runBake(*command, context);
  });
}

}  // namespace prelight::cli
