#include "cli/screen_occlusion_options.h"

#include "cli/parameters.h"
#include "cli/values.h"
#include "viewer/screen/occlusion_parameters.h"

namespace prelight::cli {

namespace {

constexpr const char* heading = "Occlusion found while drawing (--shading screen)";

}  // namespace

void addScreenOcclusionOptions(CLI::App& app, viewer::ScreenOcclusionOptions& options) {
  using viewer::OcclusionMethod;
  addNamed<OcclusionMethod, 6>(
      app, "--occlusion",
      {{{"ssao", OcclusionMethod::Ssao},
        {"hbao", OcclusionMethod::Hbao},
        {"gtao", OcclusionMethod::Gtao},
        {"disks", OcclusionMethod::Disks},
        {"ssdo", OcclusionMethod::Ssdo},
        {"fields", OcclusionMethod::Fields}}},
      [&](OcclusionMethod method) { options.method = method; },
      "how it is found: ssao, from points; hbao, from horizons; gtao (default), from slices; ssdo, from "
      "slices, "
      "with the light that arrives through them; disks, from all surfaces of the scene; fields, from what "
      "each "
      "object hides around it")
      ->group(heading);
  addNamed<bool, 2>(
      app, "--occlusion-filter", {{{"bilateral", true}, {"none", false}}},
      [&](bool filtered) { options.filtered = filtered; },
      "bilateral (default) averages pixels of one surface; none")
      ->group(heading);
  addParameters(app, heading, viewer::screenOcclusionParameters(), options);
}

}  // namespace prelight::cli
