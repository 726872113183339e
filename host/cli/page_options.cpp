#include "cli/page_export.h"
#include "cli/values.h"
#include "prelight/picture.h"

namespace prelight::cli {

void addPageOptions(CLI::App& app, PageOptions& options) {
  app.add_option(
         "--env", options.skies,
         "web: a sky of the page, as render takes it; may be repeated, and the first one is there when "
         "the page opens")
      ->type_name("MAP")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addRealNumber(
      app, "--exposure", {leastExposure, mostExposure}, [&](double factor) { options.exposure = factor; },
      "web: factor of radiance when the page opens (default: 1)");
}

}  // namespace prelight::cli
