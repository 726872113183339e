#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "prelight/bake.h"
#include "prelight/scene.h"

namespace prelight::cli {

class Session;
struct PictureOptions;

/// Names of numbered files, made from a path whose name holds %d, or %0Nd for at least N digits.
class FrameNames {
 public:
  /// Throws UsageError if the name does not hold exactly one such place.
  explicit FrameNames(const std::filesystem::path& pattern);

  std::filesystem::path of(std::size_t frame) const;

 private:
  std::filesystem::path folder_;
  std::string before_, after_;
  std::size_t digits_ = 1;
};

/// Returns the moments of --fps, beginning with the one that is asked for, else with the first key. Throws
/// UsageError if there are none or too many.
std::vector<SceneMoment> momentsOf(const PictureOptions& options, const Scene& scene, const Bake& bake,
                                   double framesASecond);

/// Draws an animation as numbered pictures, from the moment that is asked for, else from its start, to its
/// end. Throws UsageError if there is no animation.
void renderSequence(Session& session, const PictureOptions& options, double framesASecond,
                    const std::filesystem::path& output);

}  // namespace prelight::cli
