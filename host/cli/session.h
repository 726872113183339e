#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/console/console.h"
#include "cli/console/device_progress.h"
#include "cli/console/kept_state.h"
#include "cli/console/terminal_progress.h"
#include "cli/context.h"
#include "cli/stage_times.h"
#include "library/open_scene.h"
#include "library/run_bake.h"
#include "pictures/session/drawing_session.h"
#include "prelight/bake.h"
#include "prelight/device.h"

namespace prelight::cli {

using pictures::requireTriangles;

/// The common part of every command: console, progress, times and warnings, and the pipelines openScene() and
/// runBake(), whose steps are timed and can be interrupted.
class Session final : public pictures::DrawingSession {
 public:
  explicit Session(Context& context)
      : context_(context),
        console_(context.options, context.output),
        progress_(context.options, context.signals),
        deviceProgress_(console_, progress_, [this](const std::string& warning) { warn(warning); }),
        steps_(progress_, times_) {}

  const GlobalOptions& options() const { return context_.options; }
  const Console& console() const { return console_; }
  TerminalProgress& progress() override { return progress_; }
  StageTimes& times() { return times_; }
  const Warnings& warnings() const { return warnings_; }

  void note(const std::string& text) override { console_.note(text); }
  void warn(const std::string& warning) override;

  /// Reads and flattens a glTF file and shows what was odd about it.
  LoadedScene load(const std::filesystem::path& path, const LoadOptions& options = {}) override {
    return load(path, options, false);
  }

  /// With `tellOddities` also shows what does no harm here.
  LoadedScene load(const std::filesystem::path& path, LoadOptions options, bool tellOddities);

  /// Plans and bakes; throws as runBake() does. `state` keeps what is done, and `key` names what that depends
  /// on besides the bake's own settings.
  BakeRun bake(const LoadedScene& loaded, const BakeRequest& request, const DeviceOptions& deviceOptions,
               KeptState* state, const StateKey& key);

  BakeRun bake(const LoadedScene& loaded, const BakeRequest& request,
               const DeviceOptions& deviceOptions) override {
    return bake(loaded, request, deviceOptions, nullptr, {});
  }

  /// Refines and prints what was done; throws as refineScene() does.
  RefinedScene refine(LoadedScene loaded, const RefineRequest& request,
                      const DeviceOptions& deviceOptions) override;

  /// Returns the options for opening a device, from --device. Warns if compiled kernels cannot be kept.
  DeviceOptions deviceOptions() override;
  using DrawingSession::deviceOptions;

  StopSignals& signals() { return context_.signals; }

 private:
  void runStage(const char* stage, const std::function<void()>& work) override {
    times_.measure(stage, work);
    progress_.clear();
  }

  class TimedSteps final : public Steps {
   public:
    TimedSteps(Progress& progress, StageTimes& times) : Steps(progress), times_(times) {}

   private:
    void measure(const char* name, const std::function<void()>& work) override { times_.measure(name, work); }

    StageTimes& times_;
  };

  Context& context_;
  Console console_;
  TerminalProgress progress_;
  DeviceProgress deviceProgress_;
  StageTimes times_;
  TimedSteps steps_;
  Warnings warnings_;
  bool warnedOfCache_ = false;
};

/// Returns a file's bake. Throws InputError if there is none.
Bake requireBake(Session& session, const LoadedScene& loaded);

}  // namespace prelight::cli
