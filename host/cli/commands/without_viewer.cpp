#include "cli/commands.h"
#include "cli/commands/page_export.h"
#include "prelight/draw.h"
#include "prelight/error.h"

namespace prelight {

HemisphereRendererMaker openGlHemispheres() { return {}; }

}  // namespace prelight

/// Replaces render, view and pages in a build with PRELIGHT_VIEWER=OFF.
namespace prelight::cli {
namespace {

void addMissingCommand(CLI::App& program, const std::string& name) {
  CLI::App* app = program.add_subcommand(name, "Not in this build (PRELIGHT_VIEWER=OFF)");
  app->allow_extras()->fallthrough(false);
  app->callback([name] {
    throw UsageError(name, "this build has no viewer", "configure it with -DPRELIGHT_VIEWER=ON");
  });
}

}  // namespace

void addRenderCommand(CLI::App& program, Context&) { addMissingCommand(program, "render"); }

void addReferenceCommand(CLI::App& program, Context&) { addMissingCommand(program, "reference"); }

void addViewCommand(CLI::App& program, Context&) { addMissingCommand(program, "view"); }

nlohmann::ordered_json exportPage(Session&, const ExportOptions&, const LoadedScene&, const Bake&) {
  throw UsageError("--target web", "this build has no viewer", "configure it with -DPRELIGHT_VIEWER=ON");
}

}  // namespace prelight::cli
