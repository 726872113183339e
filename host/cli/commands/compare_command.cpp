#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "base/spans.h"
#include "cli/commands.h"
#include "cli/report.h"
#include "cli/session.h"
#include "prelight/picture.h"
#include "techniques/registry/registry.h"

namespace prelight::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CompareCommand {
  std::filesystem::path first;
  std::filesystem::path second;
};

/// The differences of two arrays of numbers. Pairs in which a number is not finite are counted and left out.
struct Difference {
  double rms = 0.0;
  double relativeMse = 0.0;  ///< mean of (a - b)^2 / (b^2 + 0.01)
  double max = 0.0;
  double firstMean = 0.0;
  double secondMean = 0.0;
  std::size_t count = 0;
  std::size_t notFinite = 0;
};

Difference difference(std::span<const float> first, std::span<const float> second) {
  constexpr double relativeFloor = 0.01;
  Difference result;
  double squares = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double a = first[i];
    const double b = second[i];
    if (!std::isfinite(a) || !std::isfinite(b)) {
      ++result.notFinite;
      continue;
    }
    const double square = (a - b) * (a - b);
    squares += square;
    result.relativeMse += square / (b * b + relativeFloor);
    result.max = std::max(result.max, std::abs(a - b));
    result.firstMean += a;
    result.secondMean += b;
    ++result.count;
  }
  const double scale = result.count > 0 ? 1.0 / static_cast<double>(result.count) : 0.0;
  result.rms = std::sqrt(squares * scale);
  result.relativeMse *= scale;
  result.firstMean *= scale;
  result.secondMean *= scale;
  return result;
}

Json differenceJson(const Difference& d) {
  return {{"rmse", d.rms},           {"relMSE", d.relativeMse}, {"max", d.max},
          {"meanA", d.firstMean},    {"meanB", d.secondMean},   {"values", d.count},
          {"notFinite", d.notFinite}};
}

void printDifference(const Console& console, const std::string& label, const Difference& d) {
  console.line(label, fmt::format("rmse {:.6g}, relMSE {:.6g}, max {:.6g}, mean {:.6g} and {:.6g}", d.rms,
                                  d.relativeMse, d.max, d.firstMean, d.secondMean));
}

bool isScene(const std::filesystem::path& path) {
  return path.extension() == ".glb" || path.extension() == ".gltf";
}

using Differences = std::vector<std::pair<std::string, Difference>>;

Differences comparePictures(const CompareCommand& command) {
  const Picture first = readPicture(command.first);
  const Picture second = readPicture(command.second);
  if (first.width != second.width || first.height != second.height)
    throw InputError(command.second.string(),
                     fmt::format("is {}x{}, expected {}x{} like {}", second.width, second.height, first.width,
                                 first.height, command.first.string()),
                     "compare pictures of the same size");
  return {{"picture", difference(numbersOf(first.pixels), numbersOf(second.pixels))}};
}

Difference difference(const BakedArray& first, const BakedArray& second) {
  const auto joined = [](const BakedArray& array) {
    std::vector<float> values;
    for (const std::span<const float> part : array.parts)
      values.insert(values.end(), part.begin(), part.end());
    return values;
  };
  return difference(joined(first), joined(second));
}

Differences compareBakes(const CompareCommand& command, Session& session) {
  const LoadedScene firstScene = session.load(command.first);
  const LoadedScene secondScene = session.load(command.second);
  const Bake first = requireBake(session, firstScene);
  const Bake second = requireBake(session, secondScene);
  const std::uint32_t vertices = firstScene.compiled.vertexCount();
  if (secondScene.compiled.vertexCount() != vertices)
    throw InputError(command.second.string(),
                     fmt::format("has {} vertices, expected {} like {}", secondScene.compiled.vertexCount(),
                                 vertices, command.first.string()),
                     "compare bakes of the same scene");
  Differences result;
  const std::vector<BakedArray> others = arraysOf(second);
  for (const BakedArray& one : arraysOf(first)) {
    const auto other = std::find_if(others.begin(), others.end(),
                                    [&](const BakedArray& candidate) { return candidate.name == one.name; });
    if (other == others.end()) continue;
    if (other->layout == one.layout)
      result.emplace_back(one.name, difference(one, *other));
    else
      session.warn(fmt::format("{}: {} in the first file, {} in the second, so they are not compared",
                               one.name, one.layout, other->layout));
  }
  if (result.empty())
    throw InputError(command.second.string(),
                     fmt::format("shares no technique with {}", command.first.string()),
                     "bake both with the same options");
  return result;
}

void runCompare(const CompareCommand& command, Context& context) {
  Session session(context);
  if (isScene(command.first) != isScene(command.second))
    throw UsageError("compare", fmt::format("got {} and {}, expected two pictures or two baked files",
                                            command.first.string(), command.second.string()));
  const Differences differences =
      isScene(command.first) ? compareBakes(command, session) : comparePictures(command);
  Json json = reportOf("compare", {{"a", command.first.string()}, {"b", command.second.string()}});
  for (const auto& [name, d] : differences) {
    if (d.notFinite > 0)
      session.warn(fmt::format("{}: {} values are not finite and were left out", name, d.notFinite));
    printDifference(session.console(), name, d);
    json[name] = differenceJson(d);
  }
  json["warnings"] = session.warnings();
  session.console().json(json);
}

}  // namespace

void addCompareCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<CompareCommand>();
  CLI::App* app =
      program.add_subcommand("compare", "Measure how far two pictures, or two baked files, are apart");
  app->add_option("A", command->first, "picture (.exr, .hdr, .png) or baked .glb")->required()->type_name("");
  app->add_option("B", command->second, "picture or .glb to compare it with, to which relative errors refer")
      ->required()
      ->type_name("");
  app->footer(
      "relMSE is the mean of (a - b)^2 / (b^2 + 0.01).\n\n"
      "Examples:\n"
      "  prelight compare picture.exr reference.exr\n"
      "  prelight compare quick.glb exact.glb --json");
  app->callback([command, &context] { runCompare(*command, context); });
}

}  // namespace prelight::cli
