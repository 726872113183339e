#include "cli/screen_occlusion_options.h"

#include "cli/parameters.h"
#include "cli/values.h"
#include "viewer/options/occlusion_parameters.h"

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
      "method: ssao, with points; hbao, with horizons; gtao (default), with slices; ssdo, with slices and "
      "the light that arrives through them; disks, with all surfaces of the scene; fields, with a "
      "precomputed field of occlusion around each object")
      ->group(heading);
  addNamed<bool, 2>(
      app, "--occlusion-filter", {{{"bilateral", true}, {"none", false}}},
      [&](bool filtered) { options.filtered = filtered; },
      "bilateral (default) averages pixels of one surface; none")
      ->group(heading);
  addParameters(app, heading, viewer::screenOcclusionParameters(), options);
}

}  // namespace prelight::cli
