#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "prelight/bake.h"
#include "prelight/scene.h"

namespace prelight::cli {

class Session;
struct PictureOptions;

/// Names of numbered files: those of a path whose name has %d, or %0Nd for N digits and more.
class FrameNames {
 public:
  /// Throws UsageError for a name without exactly one such place.
  explicit FrameNames(const std::filesystem::path& pattern);

  std::filesystem::path of(std::size_t frame) const;

 private:
  std::filesystem::path folder_;
  std::string before_, after_;
  std::size_t digits_ = 1;
};

/// The moments of --fps: from the one that is asked for, or the first key, on. Throws UsageError where there
/// are none, or too many.
std::vector<SceneMoment> momentsOf(const PictureOptions& options, const Scene& scene, const Bake& bake,
                                   double framesASecond);

/// Draws an animation as numbered pictures, from its start or the moment that is asked for to its end.
/// Throws UsageError where there is none to draw.
void renderSequence(Session& session, const PictureOptions& options, double framesASecond,
                    const std::filesystem::path& output);

}  // namespace prelight::cli
