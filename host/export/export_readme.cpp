#include "export/export_readme.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/text.h"
#include "export/export_bake.h"
#include "export/relight_module.h"
#include "export/text_sources.h"

namespace prelight {

namespace {

void replaceAll(std::string& text, const std::string& mark, const std::string& by) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
}

/// Returns a file's name within a URL, which then ends no string of a script either.
std::string nameInUrl(const std::string& name) {
  const std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.~";
  std::string encoded;
  for (const char c : name)
    encoded += plain.find(c) != std::string_view::npos
                   ? std::string(1, c)
                   : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  return encoded;
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
    return fmt::format("The scene's lights ({}) were removed, because the baked data hold their light.",
                       report.lights);
  return fmt::format(
      "The scene's lights ({}) have `extras.prelight.baked`: the baked data hold their light, so leave them "
      "out for surfaces with such data.",
      report.lights);
}

/// Returns whether files of directions are exported; Godot and Blender show light maps without them.
bool hasDirectionFiles(ExportTarget target) {
  return target != ExportTarget::Blender && target != ExportTarget::Godot;
}

std::string filledIn(const std::string& source, const std::string& name, const ExportReport& report,
                     const ExportRequest& request) {
  std::string text = exportTextSources().at(source);
  const auto held = exportTextSources().find(
      fmt::format("held.{}.md", exportFormNames[static_cast<std::size_t>(request.form)]));
  if (held != exportTextSources().end()) replaceAll(text, "{HELD}", held->second);
  replaceAll(text, "{DIRECTIONS}",
             report.directions && hasDirectionFiles(request.target)
                 ? exportTextSources().at("held.directions.md")
                 : std::string());
  replaceAll(text, "{DIRECTIONPICTURE}",
             report.directions
                 ? ", and `{NAME}.lightmap.direction.png` (texture type *Directional Lightmap*, "
                   "not sRGB) for normal maps"
                 : "");
  replaceAll(text, "{SKY}", report.skyPictures > 0 ? exportTextSources().at("held.sky.md") : std::string());
  replaceAll(text, "{FILES}", fileTable(report));
  replaceAll(text, "{LIGHTS}", lightsText(report, request));
  replaceAll(text, "{COLORSCALE}", fmt::format("{:.6g}", report.meshes.colorScale));
  replaceAll(text, "{TITLE}", escapedText(name));
  replaceAll(text, "{URLNAME}", nameInUrl(name));
  replaceAll(text, "{NAME}", name);
  return text;
}

bool has(const ExportReport& report, const std::string& file) {
  return std::any_of(report.files.begin(), report.files.end(),
                     [&](const ExportedFile& known) { return known.name == file; });
}

/// Collects the texts of an export, with their placeholders filled in.
class Texts {
 public:
  Texts(const std::string& name, const ExportReport& report, const ExportRequest& request)
      : name_(name), report_(report), request_(request) {}

  void add(const std::string& file, const std::string& source, const char* contents) {
    texts_.push_back({file, contents, filledIn(source, name_, report_, request_)});
  }
  void addAsIs(const std::string& file, std::string text, const char* contents) {
    texts_.push_back({file, contents, std::move(text)});
  }
  std::vector<TextFile> take() { return std::move(texts_); }

 private:
  const std::string& name_;
  const ExportReport& report_;
  const ExportRequest& request_;
  std::vector<TextFile> texts_;
};

}  // namespace

std::vector<TextFile> exportTexts(const std::string& name, const ExportReport& report,
                                  const ExportRequest& request) {
  const std::string target(exportTargetNames[static_cast<std::size_t>(request.target)]);
  const bool mapped = request.form == ExportForm::LightMap;
  Texts texts(name, report, request);
  const bool relit = request.form == ExportForm::Transfer && request.target == ExportTarget::Three;
  if (relit) {
    texts.addAsIs("prelight.js", relightModule(), "relights the scene in three.js");
    texts.add("index.html", "relight_page.html", "a page that shows it; needs three.js");
  }
  if (mapped && request.target == ExportTarget::Three)
    texts.add("prelight_light_map.js", "prelight_light_map.js", "loads the light map in three.js");
  if (mapped && request.target == ExportTarget::Blender)
    texts.add("load_in_blender.py", "load_in_blender.py",
              "imports the scene into Blender with its light map");
  if (mapped && request.target == ExportTarget::Godot)
    texts.add("prelight_light_map.gd", "prelight_light_map.gd", "shows the light map in Godot 4");
  if (mapped && request.target == ExportTarget::Godot)
    texts.add("prelight_light_map_godot3.gd", "prelight_light_map_godot3.gd", "the same in Godot 3");
  if (mapped && request.target == ExportTarget::Unity)
    texts.add("PrelightLightMap.cs", "PrelightLightMap.cs", "shows the light map in Unity");
  if (request.target == ExportTarget::Raw && has(report, name + ".vertices.json"))
    texts.add("relight.py", "relight.py", "reads the vertices' numbers and lights the vertices (numpy)");
  // Without a light map, only targets that read raw arrays need instructions.
  const bool told = mapped || request.target == ExportTarget::Raw;
  texts.add("README.md",
            fmt::format("README.{}.md", relit  ? "relight"
                                        : told ? target
                                               : "gltf"),
            "how to load it");
  return texts.take();
}

std::vector<TextFile> volumeTexts(const std::string& name, const ExportReport& report,
                                  const ExportRequest& request) {
  const bool probes = request.form == ExportForm::Probes;
  Texts texts(name, report, request);
  if (probes && request.target != ExportTarget::Raw)
    texts.add("prelight_probes.js", "prelight_probes.js", "loads the probes in three.js");
  const char* readme = probes ? "README.probes.md" : "README.volume.md";
  texts.add(readme, readme, "how to read it");
  return texts.take();
}

}  // namespace prelight
