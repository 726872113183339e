// Values of options. The first line chooses a parser; the other lines are its text, or arguments one a line.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bake/make_plan.h"
#include "base/text.h"
#include "cli/options/bake_options.h"
#include "cli/options/light_option.h"
#include "cli/options/object_option.h"
#include "cli/options/options.h"
#include "cli/options/pose_options.h"
#include "cli/options/scene_options.h"
#include "cli/options/sky_option.h"
#include "cli/options/values.h"
#include "fuzz/sound.h"
#include "fuzz/target.h"
#include "plan/check_request.h"
#include "prelight/shading.h"
#include "prelight/transfer.h"
#include "viewer/options/group_option.h"
#include "viewer/options/light_option.h"
#include "viewer/options/part_option.h"
#include "viewer/options/shading_options.h"

namespace prelight::fuzz {

namespace {

void readLight(const std::string& text) { requireSound(viewer::parseLight(text)); }

void readGroup(const std::string& text) {
  const GroupFactor factor = viewer::parseGroupFactor(text);
  for (int c = 0; c < 3; ++c)
    require(std::isfinite(factor.factor[c]) && factor.factor[c] >= 0.0f,
            "factors are finite and not negative");
}

void readPart(const std::string& text) {
  viewer::LayerFactors factors = viewer::wholePicture;
  viewer::setPartFactor(text, factors);
  for (const float factor : factors)
    require(std::isfinite(factor) && factor >= 0.0f, "factors are finite and not negative");
}

void readCompression(const std::string& text) {
  const CompressionRequest request = parseCompression(text);
  require(compressionName(parseCompression(compressionName(request))) == compressionName(request),
          "names of compressions read back as themselves");
}

void readPattern(const std::string& text) {
  const std::size_t split = text.find('\n');
  if (split != std::string::npos) (void)matchesPattern(text.substr(0, split), text.substr(split + 1));
  (void)splitPatterns(text);
  (void)numbersIn(text, 1e6);
  (void)didYouMean(text, std::vector<std::string>{"ambient", "direct", "reflected"});
}

/// One triangle, of which plans are made.
CompiledScene triangle() {
  CompiledScene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.normals.assign(3, {0, 0, 1});
  scene.texCoords.assign(3, {0, 0});
  scene.triangles = {{0, 1, 2}};
  scene.triangleMaterials = {0};
  scene.triangleFlat = {0};
  scene.materials.resize(1);
  scene.boundsMax = {1, 1, 0};
  return scene;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

/// Everything that commands read from their arguments, without a command.
struct Arguments {
  cli::BakeSettings bake;
  LoadOptions load;
  pictures::PoseOptions pose;
  std::vector<PlacedObject> objects;
  std::optional<std::vector<Light>> lights;
  std::filesystem::path sky;
  viewer::ShadingOptions shading;
  std::uint64_t seed = 0;

  void addTo(CLI::App& app) {
    cli::addTechniqueOptions(app, bake);
    cli::addRefineOptions(app, bake);
    cli::addMapPhotonOptions(app, bake.request);
    cli::addEffortOptions(app, bake);
    cli::addKernelOptions(app, bake);
    cli::addSceneOptions(app, load);
    cli::addPoseOptions(app, pose);
    cli::addObjectOption(app, objects, "");
    cli::addLightOption(app, lights);
    cli::addSkyOption(app, sky, "");
    cli::addPictureSize(
        app, "--size",
        [](const cli::PictureSize& size) {
          require(size.height > 0 && size.width.value_or(1) > 0, "sizes of pictures are above 0");
        },
        "");
  }
};

/// Reads arguments and plans the bake that they ask for.
void readArguments(const std::string& text) {
  Arguments arguments;
  CLI::App app;
  arguments.addTo(app);
  std::vector<std::string> lines = linesOf(text);
  std::ranges::reverse(lines);  // as the parser takes them
  try {
    app.parse(lines);
  } catch (const CLI::ParseError&) {
    return;
  }
  requireRanges(arguments.load);
  for (const Light& light : arguments.lights.value_or(std::vector<Light>())) requireSound(light);
  checkRequest(arguments.bake.request);
  requireUse(arguments.bake.request);
  Scene scene;
  (void)makePlan(scene, triangle(), arguments.bake.request);
}

void readOption(Bytes input) {
  const std::string text(reinterpret_cast<const char*>(input.data()), input.size());
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string kind = text.substr(0, end), rest = text.substr(std::min(end + 1, text.size()));
  if (kind == "light") readLight(rest);
  if (kind == "group") readGroup(rest);
  if (kind == "part") readPart(rest);
  if (kind == "compress") readCompression(rest);
  if (kind == "pattern") readPattern(rest);
  if (kind == "arguments") readArguments(rest);
}

}  // namespace

Target options() { return {"options", readOption}; }

}  // namespace prelight::fuzz
