#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "cli/commands.h"
#include "cli/report.h"
#include "cli/session.h"
#include "prelight/picture.h"

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

std::span<const float> floats(const std::vector<glm::vec3>& vectors) {
  return {vectors.empty() ? nullptr : &vectors.front().x, vectors.size() * 3};
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
  return {{"picture", difference(floats(first.pixels), floats(second.pixels))}};
}

void compareTexels(const ChartTransfer& first, const ChartTransfer& second, Session& session,
                   Differences& result) {
  std::vector<float> a, b;
  for (const ChartTransfer::Map& map : first.maps)
    a.insert(a.end(), map.coefficients.begin(), map.coefficients.end());
  for (const ChartTransfer::Map& map : second.maps)
    b.insert(b.end(), map.coefficients.begin(), map.coefficients.end());
  const auto sameShape = [](const ChartTransfer::Map& one, const ChartTransfer::Map& other) {
    return one.primitive == other.primitive && one.width == other.width && one.height == other.height;
  };
  if (first.rowLength() == second.rowLength() && first.channels == second.channels &&
      std::equal(first.maps.begin(), first.maps.end(), second.maps.begin(), second.maps.end(), sameShape))
    result.emplace_back("texels", difference(a, b));
  else
    session.warn("the light maps differ in order, channels or size and are not compared");
}

/// Compares the encodings that both bakes have, under names `place`.NAME.
void compareEncoded(const std::string& place, const std::vector<EncodedLight>& first,
                    const std::vector<EncodedLight>& second, Session& session, Differences& result) {
  for (const EncodedLight& one : first) {
    const auto other = std::find_if(second.begin(), second.end(), [&](const EncodedLight& candidate) {
      return candidate.encoding == one.encoding;
    });
    if (other == second.end()) continue;
    const std::string name = place + "." + one.encoding;
    if (one.values.size() == other->values.size())
      result.emplace_back(name, difference(one.values, other->values));
    else
      session.warn(fmt::format("the values of {} differ in number and are not compared", name));
  }
}

void compareLightMaps(const LightMap& first, const LightMap& second, Session& session, Differences& result) {
  const bool sameSize =
      first.layout.width == second.layout.width && first.layout.height == second.layout.height;
  if (sameSize && first.coefficients == second.coefficients)
    result.emplace_back("lightMap", difference(first.values, second.values));
  else
    session.warn("the light maps differ in size or coefficients and are not compared");
  if (sameSize) compareEncoded("lightMap", first.encoded, second.encoded, session, result);
}

void compareLightGroups(const LightGroupTransfer& first, const LightGroupTransfer& second, Session& session,
                        Differences& result) {
  const auto sameName = [](const LightGroup& one, const LightGroup& other) { return one.name == other.name; };
  if (first.channels == second.channels && std::equal(first.groups.begin(), first.groups.end(),
                                                      second.groups.begin(), second.groups.end(), sameName))
    result.emplace_back("lightGroups", difference(first.coefficients, second.coefficients));
  else
    session.warn("the light groups differ and are not compared");
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
  if (!first.ao.empty() && !second.ao.empty()) result.emplace_back("ao", difference(first.ao, second.ao));
  if (!first.bentNormals.empty() && !second.bentNormals.empty())
    result.emplace_back("bentNormal", difference(floats(first.bentNormals), floats(second.bentNormals)));
  if (first.horizons && second.horizons && first.horizons->sectors == second.horizons->sectors)
    result.emplace_back("horizons", difference(first.horizons->angles, second.horizons->angles));
  if (first.horizons && second.horizons && !first.horizons->feet.empty() &&
      first.horizons->feet.size() == second.horizons->feet.size())
    result.emplace_back("feet of horizons", difference(first.horizons->feet, second.horizons->feet));
  if (first.irradiance && second.irradiance)
    result.emplace_back("irradiance", difference(floats(*first.irradiance), floats(*second.irradiance)));
  const auto compareHarmonics = [&](const char* name, const auto& one, const auto& other) {
    if (!one || !other) return;
    if (one->order == other->order && one->channels == other->channels)
      result.emplace_back(name, difference(one->coefficients, other->coefficients));
    else
      session.warn(fmt::format("the {} transfers differ in order or channels and are not compared", name));
  };
  compareHarmonics("sh", first.sh, second.sh);
  compareHarmonics("ch", first.ch, second.ch);
  if (first.lightGroups && second.lightGroups)
    compareLightGroups(*first.lightGroups, *second.lightGroups, session, result);
  compareEncoded("vertices", first.encodedLight, second.encodedLight, session, result);
  if (first.chartTransfer && second.chartTransfer)
    compareTexels(*first.chartTransfer, *second.chartTransfer, session, result);
  if (first.lightMap && second.lightMap) compareLightMaps(*first.lightMap, *second.lightMap, session, result);
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
