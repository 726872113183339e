#include "cli/bake_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <limits>
#include <string_view>
#include <utility>

#include "base/text.h"
#include "cli/parameters.h"
#include "cli/values.h"
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

void addLightGroupOptions(CLI::App& app, BakeRequest& request) {
  app.add_flag("--light-groups", request.lightGroups.wanted,
               "transfer of the scene's own lights, each of which can be scaled and coloured at run time");
  app.add_option_function<std::vector<std::string>>(
         "--light-group",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) request.lightGroups.named.push_back(parseLightGroup(text));
           request.lightGroups.wanted = true;
         },
         "group of lights that change together: NAME=PATTERN[,PATTERN...], with patterns (* and ?) for names "
         "of lights or nodes; repeat it for more groups; every other light is a group of its own")
      ->type_name("GROUP")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void readOccluderKind(const std::string& text, BakeRequest& request) {
  constexpr std::array<std::pair<std::string_view, OccluderKind>, 3> kinds = {
      {{"node", OccluderKind::Node}, {"mesh", OccluderKind::Mesh}, {"material", OccluderKind::Material}}};
  for (const auto& [name, kind] : kinds)
    if (text == name) {
      request.occluders.kind = kind;
      return;
    }
  int records = 0;
  const char* first = text.data() + std::min<std::size_t>(text.size(), 5);
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), records);
  if (!text.starts_with("auto:") || error != std::errc{} || end != text.data() + text.size() || records < 1 ||
      records > 256)
    throw CLI::ValidationError(
        "--occluders",
        fmt::format("got '{}', expected node, mesh, material or auto:N with N from 1 to 256", text));
  request.occluders.kind = OccluderKind::Auto;
  request.occluders.records = records;
}

void addOccluderOptions(CLI::App& app, BakeRequest& request) {
  app.add_flag("--vo", request.occluders.wanted,
               "vector occluders: what every vertex sees of each object, for shadows and colour bleeding");
  app.add_option_function<std::string>(
         "--occluders", [&](const std::string& text) { readOccluderKind(text, request); },
         "what forms one occluder: node (default), mesh, material, or auto:N, parts of nodes, chosen for "
         "every vertex so that there are N records per vertex on average")
      ->type_name("KIND");
  addParameter(app, "vo-min-form-factor", request);
}

void addOpennessOptions(CLI::App& app, BakeRequest& request) {
  app.add_flag("--ao", request.ao, "ambient occlusion and bent normal");
  app.add_flag_callback(
      "--cones", [&] { request.ao = request.cones = true; },
      "ambient occlusion and bent normal with the angle of the open cone about the bent normal, which "
      "shadows sky, lights and reflections");
  addParameter(app, "horizons", request);
}

void addOcclusionOptions(CLI::App& app, BakeRequest& request) {
  for (const char* option : {"near", "far", "obscurance"}) addParameter(app, option, request);
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

void addLightMapOptions(CLI::App& app, BakeRequest& request) {
  app.add_flag("--lightmap", request.lightMap.wanted,
               "light map: irradiance of the scene's own lights, direct and through all bounces, in an .exr "
               "beside the file and at the vertices; charts are made for all meshes");
  addParameter(app, "texel-size", request);
  addParameter(app, "texel-error", request)->type_name("E");
  app.add_flag("--denoise", request.lightMap.denoise,
               "light map, and full shading of render: remove noise with Intel Open Image Denoise 2, whose "
               "library must be installed or named by PRELIGHT_OIDN_LIBRARY");
  app.add_option_function<std::string>(
         "--encode", [&](const std::string& text) { readEncodings(text, request.encodedLight); },
         fmt::format("light map: also store how the light at texels and vertices depends on direction, for "
                     "normal maps, in the encodings NAME[,NAME...] from {}",
                     encodingNames()))
      ->type_name("NAMES");
}

void addRadiosityOptions(CLI::App& app, BakeRequest& request) {
  RadiosityRequest& shape = request.radiosity;
  app.add_flag(
      "--radiosity", request.radiosity.wanted,
      "irradiance of the scene's own lights at every vertex, direct and through all diffuse bounces");
  addParameter(app, "patch-size", request);
  app.add_option_function<std::string>(
         "--solver",
         [&](const std::string& name) {
           shape.method = chooseNamed<RadiosityMethod, 4>("--solver", name,
                                                          {{{"jacobi", RadiosityMethod::Jacobi},
                                                            {"chebyshev", RadiosityMethod::Chebyshev},
                                                            {"gauss-seidel", RadiosityMethod::GaussSeidel},
                                                            {"southwell", RadiosityMethod::Southwell}}});
         },
         "radiosity: jacobi, chebyshev, gauss-seidel (default) or southwell")
      ->type_name("NAME");
  addParameter(app, "tolerance", request);
}

void addShadowSetOptions(CLI::App& app, BakeRequest& request) {
  app.add_option_function<std::vector<std::string>>(
         "--shadow-set",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) request.shadowSets.push_back(parseShadowSet(text));
         },
         "let only these OCCLUDERS cast shadows on these RECEIVERS, and the receivers on themselves only if "
         "both sides name them: RECEIVERS:OCCLUDERS, each side a list of node names or patterns with commas "
         "between; repeat it for more; with nothing after the colon the receivers have no shadows")
      ->type_name("SET")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace

void addTechniqueOptions(CLI::App& app, BakeSettings& options) {
  BakeRequest& request = options.request;
  addOpennessOptions(app, request);
  addParameter(app, "sh", request);
  addParameter(app, "ch", request);
  app.add_flag(
      "--ch-naive", request.ch.naive,
      "store plain inner products with the cpherical harmonics, which are not orthogonal: for comparison");
  addParameter(app, "near-lamps", request);
  addParameter(app, "haar", request);
  addParameter(app, "haar-error", request);
  addParameter(app, "glossy", request);
  addLightGroupOptions(app, request);
  addOccluderOptions(app, request);
  addRadiosityOptions(app, request);
  addLightMapOptions(app, request);
  addParameter(app, "volume", request);
  addParameter(app, "texels", request);
  app.add_flag("--relief", request.chartTransfer.relief,
               "with --texels: bumps of normal maps shadow one another");
  addParameter(app, "bounces", request);
  app.add_flag(
      "--specular-transport", request.specular,
      "all transfer includes light through glass and from mirrors and metal: caustics that turn with the "
      "sky, and reflections in mirrors; without it such surfaces count as opaque and black");
  app.add_flag(
      "--subsurface-transport", request.subsurface,
      "AO, SH, CH and Haar transfer include light that passes through surfaces diffusely, as through leaves, "
      "or is scattered within bodies; without it such surfaces do not show this light");
  app.add_flag_callback(
      "--glossy-bounces", [&] { request.specular = request.glossyBounces = true; },
      "--specular-transport, and also reflections by the rough lobes of all other materials");
  addOcclusionOptions(app, request);
  addShadowSetOptions(app, request);
  app.add_option_function<std::string>(
         "--compress", [&](const std::string& text) { options.compression = parseCompression(text); },
         "compress the SH transfer, including that of keys, texels and volumes: half, band8, rgbe, pca:K, "
         "vq:N or cpca:N:K (N clusters, K components)")
      ->type_name("METHOD");
}

void addEffortOptions(CLI::App& app, BakeSettings& options) {
  BakeRequest& request = options.request;
  CLI::Option* rays = addParameter(app, "rays", request);
  CLI::Option* error = addParameter(app, "error", request);
  CLI::Option* time = addParameter(app, "time", request);
  rays->excludes(error)->excludes(time);
  error->excludes(time);
  addWholeNumber(
      app, "--seed", {0, std::numeric_limits<std::uint64_t>::max()},
      [&](std::uint64_t n) { request.seed = n; },
      "seed of the random numbers (default 0); the same seed gives the same bytes");
  addParameter(app, "max-memory", request);
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
