#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "cli/bake_state.h"
#include "cli/console.h"
#include "cli/context.h"
#include "cli/stage_times.h"
#include "cli/terminal_progress.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/plan.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight::cli {

/// A file taken through the steps that every command shares.
struct LoadedScene {
  std::filesystem::path path;
  GltfDocument document;
  Scene scene;
  CompiledScene compiled;
};

/// A bake with all that is known of how it was made.
struct BakeRun {
  Plan plan;
  Bake bake;
  BakeReport report;
  DeviceInfo device;
};

/// The core of a command's run: console, progress, times and warnings, and the pipeline
/// readGltf -> loadScene -> compileScene -> makePlan -> Device::open -> bakeScene, each stage timed and
/// interruptible.
class Session {
 public:
  explicit Session(Context& context)
      : context_(context),
        console_(context.options, context.output),
        progress_(context.options, context.signals) {}

  const GlobalOptions& options() const { return context_.options; }
  const Console& console() const { return console_; }
  TerminalProgress& progress() { return progress_; }
  StageTimes& times() { return times_; }
  const Warnings& warnings() const { return warnings_; }

  void warn(const std::string& warning);

  /// Reads and flattens a glTF file and shows what was odd about it.
  LoadedScene load(const std::filesystem::path& path);

  /// Plans and bakes. Throws InputError for a scene without triangles, or for light maps of one that has no
  /// texture coordinates for them.
  BakeRun bake(const LoadedScene& loaded, const BakeRequest& request, const DeviceOptions& deviceOptions,
               BakeStateFile* state = nullptr);

  /// The options of the device layer, with what --device says. Warns where compiled kernels cannot be kept.
  DeviceOptions deviceOptions();

  StopSignals& signals() { return context_.signals; }

 private:
  Charts chartsOf(const LoadedScene& loaded, int size);

  Context& context_;
  Console console_;
  TerminalProgress progress_;
  StageTimes times_;
  Warnings warnings_;
  bool warnedOfCache_ = false;
};

/// Throws InputError for a scene that has nothing to bake.
void requireTriangles(const LoadedScene& loaded);

}  // namespace prelight::cli
