#include "benchmarks/suites/viewer/viewer_cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "benchmarks/run/measure.h"
#include "prelight/error.h"

namespace prelight::benchmarks {

namespace {

constexpr std::array<std::string_view, 5> knownScenes = {"shapes", "cornell", "rooms", "swing", "caustics"};
constexpr std::array<std::string_view, 2> openScenes = {"shapes", "swing"};

std::vector<std::string> scenesOf(const ViewerOptions& options) {
  std::vector<std::string> scenes = options.scenes;
  if (options.onlyCase.empty()) return scenes;
  for (const std::string_view known : knownScenes)
    if (std::find(scenes.begin(), scenes.end(), known) == scenes.end()) scenes.emplace_back(known);
  return scenes;
}

}  // namespace

std::string ViewerCase::name() const {
  return fmt::format("{}/{}/{}x{}", sceneName(scene), viewer::shadingName(shading), width, height);
}

std::vector<ViewerCase> viewerCases(const ViewerOptions& options) {
  std::vector<ViewerCase> chosen;
  for (const std::string& scene : scenesOf(options))
    for (const viewer::ShadingInfo& shading : viewer::shadings())
      for (const auto& [width, height] : options.sizes) {
        const ViewerCase some{scene, shading.shading, width, height};
        if (some.name().find(options.onlyCase) != std::string::npos) chosen.push_back(some);
      }
  return chosen;
}

void refuseViewerCase(const ViewerOptions& options) {
  throw UsageError("--case " + options.onlyCase, "no case of `viewer` has such a name",
                   fmt::format("they are SCENE/SHADING/WIDTHxHEIGHT, scenes {}; shadings {}",
                               fmt::join(knownScenes, " "), viewer::shadingNames()));
}

bool isShownUnderSky(const std::string& scene) {
  return std::find(openScenes.begin(), openScenes.end(), scene) != openScenes.end();
}

}  // namespace prelight::benchmarks
