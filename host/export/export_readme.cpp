#include "export/export_readme.h"

#include <fmt/format.h>

#include "export/export_bake.h"
#include "export/text_sources.h"

namespace prelight {

namespace {

void replaceAll(std::string& text, const std::string& mark, const std::string& by) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
}

std::string fileTable(const ExportReport& report) {
  std::string table = "| file | |\n|---|---|";
  for (const ExportedFile& file : report.files)
    table += fmt::format("\n| `{}` | {} |", file.name, file.contents);
  return table;
}

std::string lightsText(const ExportReport& report, const ExportRequest& request) {
  if (report.lights == 0) return "The scene has no lights of nodes.";
  if (!holdsLight(request.form) || request.lights == BakedLights::Keep)
    return fmt::format("The scene's lights ({}) are as they were.", report.lights);
  if (request.lights == BakedLights::Remove)
    return fmt::format("The scene's lights ({}) were removed, as what was baked holds their light.",
                       report.lights);
  return fmt::format(
      "The scene's lights ({}) have `extras.prelight.baked`: what was baked holds their light, so leave them "
      "out for "
      "surfaces that have it.",
      report.lights);
}

std::string filledIn(const std::string& source, const std::string& name, const ExportReport& report,
                     const ExportRequest& request) {
  std::string text = exportTextSources().at(source);
  replaceAll(text, "{HELD}",
             exportTextSources().at(
                 fmt::format("held.{}.md", exportFormNames[static_cast<std::size_t>(request.form)])));
  replaceAll(text, "{FILES}", fileTable(report));
  replaceAll(text, "{LIGHTS}", lightsText(report, request));
  replaceAll(text, "{COLORSCALE}", fmt::format("{:.6g}", report.meshes.colorScale));
  replaceAll(text, "{NAME}", name);
  return text;
}

}  // namespace

std::vector<TextFile> exportTexts(const std::string& name, const ExportReport& report,
                                  const ExportRequest& request) {
  const std::string target(exportTargetNames[static_cast<std::size_t>(request.target)]);
  const bool mapped = request.form == ExportForm::LightMap;
  std::vector<TextFile> texts;
  const auto add = [&](const char* file, const std::string& source, const char* contents) {
    texts.push_back({file, contents, filledIn(source, name, report, request)});
  };
  if (mapped && request.target == ExportTarget::Three)
    add("prelight_light_map.js", "prelight_light_map.js", "loads the light map in three.js");
  if (mapped && request.target == ExportTarget::Blender)
    add("load_in_blender.py", "load_in_blender.py", "imports the scene into Blender with its light map");
  // Without a light map there is nothing that a program must be told.
  add("README.md", fmt::format("README.{}.md", mapped ? target : "gltf"), "how to load it");
  return texts;
}

}  // namespace prelight
