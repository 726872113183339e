#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>

#include "base/text.h"
#include "basis/ch.h"
#include "basis/kept_sky.h"
#include "basis/sh_evaluate.h"
#include "cli/commands.h"
#include "cli/options/sky_option.h"
#include "cli/options/values.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/session.h"
#include "pictures/named_sky.h"
#include "plot/basis_plots.h"
#include "plot/lobe_plots.h"
#include "plot/sky_plots.h"
#include "plot/transfer_plot.h"
#include "scene/measured_brdf.h"
#include "techniques/registry/registry.h"

namespace prelight::cli {
namespace {

using plot::Drawing;
using plot::PolarCurve;
using Json = nlohmann::ordered_json;

struct PlotCommand {
  std::string kind;
  std::filesystem::path file;
  std::filesystem::path output;
  std::filesystem::path sky = pictures::studioName;
  std::optional<int> order;
  int faceSize = 0;  ///< texels along a side of the cube's faces; 0: the kind's default
  std::size_t terms = 100;
  int lights = 32;
  std::uint32_t vertex = 0;
  double roughness = 0.5;
  plot::ReflectionLobe lobe = plot::ReflectionLobe::Ggx;
};

/// A kind of plot: what draws it, and which options it takes besides -o. `facts` takes what it adds to
/// --json.
struct PlotKind {
  const char* name;
  const char* help;
  std::vector<const char*> options;
  bool takesFile;
  Drawing (*draw)(const PlotCommand& command, Session& session, Json& facts);
};

Drawing drawHarmonics(const plot::EvaluateBasis& evaluate, const PlotCommand& command) {
  constexpr int mostOrder = 8;
  const int order = command.order.value_or(4);
  if (order > mostOrder)
    throw UsageError("--order", fmt::format("got {}, expected 1 to {} for functions", order, mostOrder));
  return plot::plotHarmonics(evaluate, order);
}

Drawing drawWavelets(const PlotCommand& command, Session&, Json&) {
  const int side = command.faceSize == 0 ? 4 : command.faceSize;
  if (side != 2 && side != 4 && side != 8)
    throw UsageError("--face-size", fmt::format("got {}, expected 2, 4 or 8 for functions", side));
  return plot::plotWavelets(side, faceWavelets(side));
}

Drawing drawSky(const PlotCommand& command, Session&, Json& facts) {
  const Environment sky = pictures::readNamedSky(command.sky);
  std::vector<plot::SkyRow> rows = {plot::skyItself(sky),
                                    plot::skyInHarmonics(sky, command.order.value_or(6))};
  facts["harmonicsError"] = rows.back().error;
  rows.push_back(plot::skyInWavelets(sky, command.faceSize == 0 ? 64 : command.faceSize, command.terms));
  facts["waveletsError"] = rows.back().error;
  return plot::plotSkies(rows);
}

Drawing drawSkyLights(const PlotCommand& command, Session&, Json& facts) {
  const Environment sky = pictures::readNamedSky(command.sky);
  const std::vector<SkyLight> lights = medianCut(sky, command.lights);
  for (const SkyLight& light : lights)
    facts["lights"].push_back({{"direction", {light.direction.x, light.direction.y, light.direction.z}},
                               {"irradiance", {light.irradiance.r, light.irradiance.g, light.irradiance.b}}});
  return plot::plotSkyLights(sky, lights);
}

Drawing drawLobe(const PlotCommand& command, Session&, Json&) {
  std::vector<PolarCurve> curves = {plot::lobeCurve(command.lobe, command.roughness)};
  std::vector<int> orders = {3, 5, 8};
  if (command.order) orders = {*command.order};
  for (const int order : orders)
    curves.push_back(plot::lobeInHarmonics(command.lobe, command.roughness, order));
  for (std::size_t i = 0; i < curves.size(); ++i) curves[i].color = plot::curveColor(i);
  return plot::plotPolar(curves, true);
}

Drawing drawBrdf(const PlotCommand& command, Session& session, Json&) {
  std::shared_ptr<const MeasuredBrdf> measured;
  Warnings warnings;
  if (!command.file.empty()) measured = readMeasured(command.file, warnings);
  for (const std::string& warning : warnings) session.warn(warning);
  std::vector<PolarCurve> curves;
  for (const int degrees : {0, 30, 60, 80}) {
    const double incidence = degrees * std::numbers::pi / 180.0;
    curves.push_back(measured ? plot::measuredCurve(*measured, incidence)
                              : plot::metalCurve(command.roughness, incidence));
    curves.back().color = plot::curveColor(curves.size() - 1);
  }
  return plot::plotPolar(curves, false);
}

/// Returns the numbers of a vertex in an array of a bake.
std::span<const float> rowOf(const BakedArray& array, std::uint32_t vertex, std::uint32_t vertices) {
  const std::span<const float> numbers = array.parts.at(0);
  const std::size_t length = numbers.size() / vertices;
  return numbers.subspan(vertex * length, length);
}

Drawing drawTransfer(const PlotCommand& command, Session& session, Json& facts) {
  if (command.file.empty())
    throw UsageError("FILE", "a baked file is required",
                     "for example: prelight plot transfer baked.glb -o plot.svg");
  const LoadedScene loaded = session.load(command.file);
  const Bake bake = requireBake(session, loaded);
  const std::uint32_t vertices = loaded.compiled.vertexCount();
  if (command.vertex >= vertices)
    throw UsageError("--vertex", fmt::format("got {}, expected at most {}: the scene has {} vertices",
                                             command.vertex, vertices - 1, vertices));
  facts["vertex"] = command.vertex;
  const std::string name = fmt::format("transfer of vertex {}", command.vertex);
  for (const BakedArray& array : arraysOf(bake)) {
    if (array.name == "sh")
      return plot::plotTransfer({name, sh::evaluate, rowOf(array, command.vertex, vertices)});
    if (array.name != "ch") continue;
    if (bake.ch->naive)
      throw InputError(command.file.string(),
                       "got inner products with CH (--ch-naive), expected coefficients",
                       "bake it with --ch and without --ch-naive");
    return plot::plotTransfer({name, ch::evaluate, rowOf(array, command.vertex, vertices)});
  }
  throw InputError(command.file.string(), "has no transfer in harmonics at its vertices",
                   "bake it with --sh or --ch, and without --compress");
}

const std::array<PlotKind, 8>& plotKinds() {
  static const std::array<PlotKind, 8> kinds = {{
      {"sh",
       "spherical harmonics, a row per band",
       {"--order"},
       false,
       [](const PlotCommand& c, Session&, Json&) { return drawHarmonics(sh::evaluate, c); }},
      {"ch",
       "\"cpherical\" harmonics",
       {"--order"},
       false,
       [](const PlotCommand& c, Session&, Json&) { return drawHarmonics(ch::evaluate, c); }},
      {"wavelets", "wavelets of a face of the cube", {"--face-size"}, false, drawWavelets},
      {"sky",
       "a sky, the sky in SH, and in wavelets",
       {"--env", "--order", "--face-size", "--terms"},
       false,
       drawSky},
      {"lights", "the lights that stand for a sky", {"--env", "--sky-lights"}, false, drawSkyLights},
      {"lobe",
       "a reflection lobe and what orders 3, 5 and 8 keep of it",
       {"--lobe", "--roughness", "--order"},
       false,
       drawLobe},
      {"brdf",
       "a BRDF for light from 0, 30, 60 and 80 degrees: a metal's, or FILE in MERL's format",
       {"--roughness"},
       true,
       drawBrdf},
      {"transfer", "the transfer of a vertex of the baked FILE", {"--vertex"}, true, drawTransfer},
  }};
  return kinds;
}

const PlotKind& kindOf(const std::string& name) {
  std::vector<std::string> names;
  for (const PlotKind& kind : plotKinds()) {
    if (kind.name == name) return kind;
    names.emplace_back(kind.name);
  }
  throw UsageError("KIND", fmt::format("got '{}', expected one of {}", name, fmt::join(names, ", ")),
                   didYouMean(name, names) + "prelight plot --help shows an example of each");
}

/// Throws UsageError for a file or an option that the kind does not take.
void refuseOthers(const PlotKind& kind, const PlotCommand& command, const CLI::App& app) {
  if (!command.file.empty() && !kind.takesFile)
    throw UsageError("FILE", fmt::format("plot {} takes no file, got {}", kind.name, command.file.string()));
  for (const PlotKind& other : plotKinds())
    for (const char* option : other.options) {
      const bool takes = std::any_of(kind.options.begin(), kind.options.end(),
                                     [&](const char* taken) { return std::string_view(taken) == option; });
      if (app.count(option) > 0 && !takes)
        throw UsageError(option, fmt::format("plot {} does not take it", kind.name),
                         fmt::format("it takes {}", fmt::join(kind.options, ", ")));
    }
}

void runPlot(const PlotCommand& command, const CLI::App& app, Context& context) {
  Session session(context);
  const PlotKind& kind = kindOf(command.kind);
  refuseOthers(kind, command, app);
  checkOutputFile("-o", command.output, {".svg", ".png"});
  Json report = reportOf("plot", {{"kind", command.kind}, {"output", command.output.string()}});
  const Drawing drawing =
      session.times().measure("draw", [&] { return kind.draw(command, session, report); });
  const StopSignals::SafePoints writing(context.signals);
  plot::writeDrawing(command.output, drawing);
  session.console().line("wrote", command.output.string());
  for (const plot::Label& label : drawing.labels)
    if (drawing.labels.size() <= 4) session.console().line("shows", label.text);
  report["warnings"] = session.warnings();
  session.console().json(report);
}

std::string helpOfKinds() {
  std::string text = "Kinds:\n";
  for (const PlotKind& kind : plotKinds()) text += fmt::format("  {:<10}{}\n", kind.name, kind.help);
  return text +
         "\nA .svg file has labels, a .png file the picture alone. Blue is positive, orange negative; in "
         "maps,\n"
         "what is negative is violet.\n\n"
         "Examples:\n"
         "  prelight plot sh -o harmonics.svg --order 4\n"
         "  prelight plot ch -o ch.svg --order 5\n"
         "  prelight plot wavelets -o wavelets.svg --face-size 4\n"
         "  prelight plot sky -o sky.svg --env studio --order 6 --face-size 64 --terms 100\n"
         "  prelight plot lights -o lights.svg --env preetham:3:35:120 --sky-lights 32\n"
         "  prelight plot lobe -o lobe.svg --roughness 0.4\n"
         "  prelight plot brdf -o metal.svg --roughness 0.3\n"
         "  prelight plot transfer baked.glb -o transfer.svg --vertex 700";
}

}  // namespace

void addPlotCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<PlotCommand>();
  CLI::App* app = program.add_subcommand("plot", "Draw basis functions, skies in them, lobes and transfer");
  app->add_option("KIND", command->kind, "sh, ch, wavelets, sky, lights, lobe, brdf or transfer")
      ->required()
      ->type_name("");
  app->add_option("FILE", command->file, "baked .glb for transfer, MERL's .binary for brdf")->type_name("");
  app->add_option("-o,--output", command->output, "file to write (.svg, .png)")
      ->required()
      ->type_name("FILE");
  addWholeNumber(
      *app, "--order", {1, 32}, [command](std::uint64_t n) { command->order = static_cast<int>(n); },
      "bands: 4 for functions, up to 8; 6 for sky; of lobe 3, 5 and 8");
  addWholeNumber(
      *app, "--face-size", {2, 256}, [command](std::uint64_t n) { command->faceSize = static_cast<int>(n); },
      "texels along a side of the cube's faces, a power of two: 4 for functions, up to 8; 64 for sky");
  addWholeNumber(
      *app, "--terms", {1, 393216}, [command](std::uint64_t n) { command->terms = n; },
      "wavelets that are kept of the sky (default 100)");
  addSkyOption(*app, command->sky, "sky (default studio)");
  addWholeNumber(
      *app, "--sky-lights", {1, 4096}, [command](std::uint64_t n) { command->lights = static_cast<int>(n); },
      "lights that stand for the sky (default 32)");
  addNamed<plot::ReflectionLobe, 2>(
      *app, "--lobe", {{{"ggx", plot::ReflectionLobe::Ggx}, {"phong", plot::ReflectionLobe::Phong}}},
      [command](plot::ReflectionLobe lobe) { command->lobe = lobe; }, "ggx (default) or phong");
  addRealNumber(
      *app, "--roughness", {0.05, 1.0}, [command](double x) { command->roughness = x; },
      "of lobe and brdf (default 0.5)");
  addWholeNumber(
      *app, "--vertex", {0, UINT32_MAX},
      [command](std::uint64_t n) { command->vertex = static_cast<std::uint32_t>(n); },
      "vertex of the scene, counted over all meshes (default 0)");
  app->footer(helpOfKinds());
  app->callback([command, app, &context] { runPlot(*command, *app, context); });
}

}  // namespace prelight::cli
