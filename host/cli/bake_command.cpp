#include <fmt/format.h>

#include <memory>

#include "cli/bake_options.h"
#include "cli/bake_state.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/session.h"
#include "compress/compression_error.h"
#include "io/baked_file.h"
#include "io/environment.h"

namespace prelight::cli {
namespace {

struct BakeCommand {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::filesystem::path report;
  std::filesystem::path environment;
  bool resume = false;
  BakeOptions bake;
};

void checkOutputs(const BakeCommand& command) {
  checkOutputFile("-o", command.output, {".glb"});
  if (!command.report.empty()) checkOutputFile("--report", command.report, {".json"});
  if (!command.bake.dumpKernels.empty()) checkOutputFolder("--dump-kernels", command.bake.dumpKernels);
}

BakeRequest requestOf(const BakeCommand& command, Session& session) {
  BakeRequest request = command.bake.request;
  if (!command.bake.techniqueGiven()) {
    useDefaultTechniques(request);
    session.console().note(fmt::format("no technique named, baking {}", techniqueText(request)));
  }
  if (request.bounces > 0 && !request.carriesLight()) {
    session.warn("--bounces: ambient occlusion has none, add a transfer such as --sh N; ignored");
    request.bounces = 0;
  }
  if (command.bake.compression && request.shOrder == 0)
    throw UsageError("--compress", "it compresses SH transfer, and none is asked for", "add --sh N");
  if (request.volumeSize > 0 && request.shOrder == 0)
    throw UsageError("--volume", "a volume has the order of the SH transfer, and none is asked for",
                     "add --sh N");
  if (request.farLimit > 0.0 && request.nearLimit >= request.farLimit)
    throw UsageError("--near",
                     fmt::format("{} m is not below --far {} m", request.nearLimit, request.farLimit));
  return request;
}

BakeRun bakeKeepingState(Session& session, const LoadedScene& loaded, const BakeRequest& request,
                         const DeviceOptions& deviceOptions, BakeStateFile& state) {
  try {
    return session.bake(loaded, request, deviceOptions, &state);
  } catch (const Interrupted&) {
    throw Interrupted(state.message());
  }
}

void compressSh(Session& session, const LoadedScene& loaded, const CompressionRequest& compression,
                BakeRun& run) {
  const HarmonicTransfer full = std::move(*run.bake.sh);
  run.bake.sh.reset();
  CompressionError error;
  session.times().measure("compress", [&] {
    const std::vector<double> weights = surfaceOfVertices(loaded.compiled);
    run.bake.compressedSh = compress(full, compression, weights);
    error = compressionError(full, decompress(*run.bake.compressedSh), weights);
  });
  const double bytes = static_cast<double>(run.bake.compressedSh->byteCount());
  run.report.notes.push_back(
      fmt::format("compression {}: {:.1f} bytes a vertex instead of {}, error of the light {:.2g} "
                  "rms of a few lights, {:.2g} for the worst",
                  compressionName(compression), bytes / loaded.compiled.vertexCount(),
                  4 * full.channels * full.order * full.order, error.lightingRms, error.worstLightingRms));
}

void runBake(const BakeCommand& command, Context& context) {
  Session session(context);
  LoadedScene loaded = session.load(command.scene);
  requireTriangles(loaded);
  if (!command.environment.empty()) {
    readEnvironment(command.environment);
    session.warn("--env: the transfer holds for every sky; give the map to render or view instead");
  }
  checkOutputs(command);
  const BakeRequest request = requestOf(command, session);

  DeviceOptions deviceOptions = session.deviceOptions();
  command.bake.addTo(deviceOptions);
  session.console().line("scene", fmt::format("{}: {}", command.scene.string(), sceneText(loaded)));
  BakeStateFile state(command.output, command.resume, session.console());
  BakeRun run = bakeKeepingState(session, loaded, request, deviceOptions, state);
  if (command.bake.compression) compressSh(session, loaded, *command.bake.compression, run);
  // From here on it is sooner finished than saved, whoever asks to stop.
  session.times().measure("write", [&] {
    embedBake(loaded.document, loaded.compiled, run.bake);
    writeGlb(command.output, loaded.document);
  });
  state.remove();

  printBakeSummary(session.console(), request, run, session.times());
  session.console().line(
      "wrote", fmt::format("{} in {}", command.output.string(), shortSeconds(session.times().total())));
  if (command.report.empty() && !context.options.json) return;
  const nlohmann::ordered_json report = bakeReport("bake", loaded, command.output, request, run, session);
  if (!command.report.empty())
    writeTextFile(command.report,
                  report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  session.console().json(report);
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
  addEffortOptions(*app, command->bake);
  app->add_option("--env", command->environment,
                  "accepted for scripts; the transfer does not depend on the sky")
      ->type_name("MAP");
  app->add_option("--report", command->report, "write what the bake did")->type_name("FILE.json");
  app->add_flag("--resume", command->resume,
                "go on with an interrupted bake of the same scene and options (OUT.glb.state)");
  addKernelOptions(*app, command->bake);
  app->footer(
      "Without a technique the bake is --ao --sh 3 --bounces 1.\n\n"
      "Examples:\n"
      "  prelight bake level.glb -o baked.glb --ao --sh 4 --bounces 2\n"
      "  prelight bake level.glb -o baked.glb --ao --error 0.01 --report report.json\n"
      "  prelight bake level.glb -o baked.glb --sh 6 --haar 32 --bounces 2 --compress cpca:64:8\n"
      "  prelight bake room.glb -o baked.glb --light-groups --light-group lamps=Lamp* --bounces 3");
  app->callback([command, &context] { runBake(*command, context); });
}

}  // namespace prelight::cli
