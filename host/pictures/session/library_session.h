#pragma once

#include <string>
#include <vector>

#include "library/open_scene.h"
#include "pictures/session/drawing_session.h"
#include "prelight/draw.h"

namespace prelight::pictures {

/// The caller's side of draw(): it gathers notes and warnings, and has the device and the progress of the
/// call.
class LibrarySession final : public DrawingSession {
 public:
  explicit LibrarySession(const DrawOptions& options);

  void note(const std::string& text) override { notes_.push_back(text); }
  void warn(const std::string& warning) override { warnings_.push_back(warning); }
  Progress& progress() override { return *progress_; }
  LoadedScene load(const std::filesystem::path& path, const LoadOptions& options) override;
  BakeRun bake(const LoadedScene& loaded, const BakeRequest& request,
               const DeviceOptions& deviceOptions) override;
  RefinedScene refine(LoadedScene loaded, const RefineRequest& request,
                      const DeviceOptions& deviceOptions) override;
  DeviceOptions deviceOptions() override { return {.progress = progress_}; }
  using DrawingSession::deviceOptions;

  std::vector<std::string> takeNotes() { return std::move(notes_); }
  Warnings takeWarnings() { return std::move(warnings_); }

 private:
  void runStage(const char* stage, const std::function<void()>& work) override;

  Progress ignored_;
  Progress* progress_;
  std::vector<std::string> notes_;
  Warnings warnings_;
};

}  // namespace prelight::pictures
