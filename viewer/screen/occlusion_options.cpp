#include "viewer/screen/occlusion_options.h"

#include <algorithm>

namespace prelight::viewer {

ScreenOcclusionOptions draftOf(ScreenOcclusionOptions options) {
  options.slices = std::max(options.slices / 2, 1);
  options.steps = std::max(options.steps / 2, 1);
  options.samples = std::max(options.samples / 4, 1);
  options.opening = 2.0 * options.opening;
  return options;
}

}  // namespace prelight::viewer
