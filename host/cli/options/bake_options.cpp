#include "cli/options/bake_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "base/text.h"
#include "cli/options/options.h"
#include "prelight/error.h"
#include "techniques/encoded_light/encoding_names.h"

namespace prelight::cli {
namespace {

/// Parses "name=pattern,pattern".
LightGroupRequest parseLightGroup(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw UsageError(
        "--light-group",
        fmt::format("got '{}', expected NAME=PATTERN[,PATTERN...], as in lamps=Lamp*,Bulb", text));
  return {text.substr(0, equals), splitPatterns(text.substr(equals + 1))};
}

/// Parses "pattern,pattern:pattern,pattern".
ShadowSetRequest parseShadowSet(const std::string& text) {
  const std::size_t colon = text.find(':');
  ShadowSetRequest set;
  if (colon != std::string::npos && text.find(':', colon + 1) == std::string::npos)
    set = {splitPatterns(text.substr(0, colon)), splitPatterns(text.substr(colon + 1))};
  if (set.receivers.empty())
    throw UsageError(
        "--shadow-set",
        fmt::format("got '{}', expected RECEIVERS:OCCLUDERS with one colon and a receiver, as in "
                    "Room*,Floor:Sofa*",
                    text),
        "write *:... for all receivers, and ? for a colon in a name");
  return set;
}

/// Parses "node", "mesh", "material" or "auto:N".
void readOccluderKind(const std::string& text, BakeRequest& request) {
  constexpr std::string_view withCount = "auto:";
  const OptionInfo& records = optionNamed<BakeRequest>("vo-records");
  for (const OccluderKind kind : {OccluderKind::Node, OccluderKind::Mesh, OccluderKind::Material})
    if (text == optionNamed<BakeRequest>("vo-kind").choices[static_cast<std::size_t>(kind)].name) {
      request.occluders.kind = kind;
      return;
    }
  int count = 0;
  const char* first = text.data() + std::min(text.size(), withCount.size());
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), count);
  if (!text.starts_with(withCount) || error != std::errc{} || end != text.data() + text.size() ||
      !records.range.contains(count))
    throw CLI::ValidationError(
        "--occluders", fmt::format("got '{}', expected node, mesh, material or auto:N with N from {} to {}",
                                   text, records.range.least, records.range.most));
  request.occluders.kind = OccluderKind::Auto;
  request.occluders.records = count;
}

/// Parses "NAME,NAME".
void readEncodings(const std::string& text, EncodedLightRequest& request) {
  request.encodings.clear();
  for (const std::string& name : splitPatterns(text)) {
    requireEncoding("--encode", name);
    if (std::find(request.encodings.begin(), request.encodings.end(), name) != request.encodings.end())
      throw UsageError("--encode", fmt::format("{} is named twice", name), "name each encoding once");
    request.encodings.push_back(name);
  }
  if (request.encodings.empty())
    throw UsageError("--encode", "no encoding is named", "one of: " + encodingNames());
}

/// Adds the option of a row that the command line reads in its own way. Returns whether there is one.
bool addOwnBakeOption(CLI::App& app, OptionInfo row, BakeRequest& request) {
  const std::string_view name = row.name;
  if (name == "light-group") {
    addRepeatedOption(app, row, "GROUP", [&request](const std::string& text) {
      request.lightGroups.named.push_back(parseLightGroup(text));
      request.lightGroups.wanted = true;
    });
  } else if (name == "vo-kind") {
    addOwnOption(app, row, "KIND", [&request](const std::string& text) { readOccluderKind(text, request); });
  } else if (name == "encode") {
    const std::string help = fmt::format("{} from {}", row.help, encodingNames());
    row.help = help.c_str();
    addOwnOption(app, row, "NAMES",
                 [&request](const std::string& text) { readEncodings(text, request.encodedLight); });
  } else if (name == "shadow-set") {
    addRepeatedOption(app, row, "SET", [&request](const std::string& text) {
      request.shadowSets.push_back(parseShadowSet(text));
    });
  } else {
    return false;
  }
  return true;
}

constexpr std::array<std::string_view, 4> effortOptions = {"rays", "error", "time", "max-memory"};
/// Options of light maps that only `bake` has, because pictures have photons and caustics of their own.
constexpr std::array<std::string_view, 2> mapPhotonOptions = {"caustics", "photons"};

}  // namespace

void addTechniqueOptions(CLI::App& app, BakeSettings& options) {
  for (const Option<BakeRequest>& row : optionsOf<BakeRequest>()) {
    if (std::ranges::count(effortOptions, row.name) + std::ranges::count(mapPhotonOptions, row.name) > 0)
      continue;
    if (addOwnBakeOption(app, row, options.request) || row.kind == OptionKind::Own ||
        row.commandLine != nullptr)
      continue;
    addOption(app, row, options.request);
  }
  app.add_option_function<std::string>(
         "--compress",
         [&](const std::string& text) {
           const bool occluders = options.compression.occluders;
           options.compression = parseFileCompression(text);
           options.compression.occluders = occluders;
         },
         "make the result small: auto (all that vertices have), or a method for the SH transfer alone, "
         "including that of keys, texels and volumes: half, band8, rgbe, pca:K, vq:N or cpca:N:K (N "
         "clusters, K components); auto:METHOD does both")
      ->type_name("METHOD");
}

void addRefineOptions(CLI::App& app, BakeSettings& options) { addOptions(app, options.refine); }

void addMapPhotonOptions(CLI::App& app, BakeRequest& request) {
  for (const std::string_view name : mapPhotonOptions) addOption(app, name, request);
}

void addEffortOptions(CLI::App& app, BakeSettings& options) {
  BakeRequest& request = options.request;
  CLI::Option* rays = addOption(app, "rays", request);
  CLI::Option* error = addOption(app, "error", request);
  CLI::Option* time = addOption(app, "time", request);
  rays->excludes(error)->excludes(time);
  error->excludes(time);
  addSeedOption(app, request.seed);
  addOption(app, "max-memory", request);
}

void addKernelOptions(CLI::App& app, BakeSettings& options) {
  app.add_flag_callback(
         "--cache-kernels", [&] { options.cacheKernels = true; },
         "keep compiled kernels between runs (default)")
      ->excludes(app.add_flag_callback(
          "--no-cache-kernels", [&] { options.cacheKernels = false; }, "compile the kernels anew"));
  app.add_option("--dump-kernels", options.dumpKernels,
                 "write the source of every compiled kernel into this folder")
      ->type_name("DIR");
}

}  // namespace prelight::cli
