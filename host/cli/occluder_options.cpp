#include "cli/occluder_options.h"

#include <fmt/format.h>

#include "cli/parameters.h"
#include "cli/values.h"
#include "viewer/options/occluder_parameters.h"

namespace prelight::cli {

namespace {

constexpr const char* group = "Vector occluders (--shading vo)";

}  // namespace

void addOccluderOptions(CLI::App& app, viewer::OccluderOptions& options) {
  addNamed<OccluderFormula, 2>(
      app, "--shadow-formula", {{{"soft", OccluderFormula::Soft}, {"thesis", OccluderFormula::Thesis}}},
      [&](OccluderFormula formula) { options.shading.formula = formula; },
      "formula for shadows: soft (default), or thesis, the one of Sherif's thesis (2013)")
      ->group(group);
  addNamed<MirrorFormula, 2>(
      app, "--mirror-formula", {{{"lobe", MirrorFormula::Lobe}, {"thesis", MirrorFormula::Thesis}}},
      [&](MirrorFormula formula) { options.shading.mirrors = formula; },
      "formula for reflections of occluders: lobe (default), which conserves energy, or thesis, the one of "
      "Sherif's thesis (2013)")
      ->group(group);
  addNamed<DiffuseReceiver, 2>(
      app, "--receiver",
      {{{"lambert", DiffuseReceiver::Lambert}, {"oren-nayar", DiffuseReceiver::OrenNayar}}},
      [&](DiffuseReceiver receiver) { options.shading.receiver = receiver; },
      "diffuse surfaces: lambert (default), or oren-nayar, as rough as their material")
      ->group(group);
  addNamed<bool, 2>(
      app, "--highlights", {{{"metals", false}, {"all", true}}},
      [&](bool all) { options.allHighlights = all; },
      "surfaces that mirror lights, with shadows: metals and glass (default), or all surfaces")
      ->group(group);
  addParameters(app, group, viewer::occluderParameters(), options);
  addWholeNumber(
      app, "--sky-lights", {1, viewer::mostSkyLights},
      [&](std::uint64_t n) { options.skyLights = static_cast<int>(n); },
      fmt::format("number of lights that represent the sky (default {})", defaultSkyLights))
      ->group(group);
}

}  // namespace prelight::cli
