#include "library/open_scene.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/baked_file.h"
#include "io/baked_strip.h"
#include "prelight/load.h"
#include "prelight/options.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/json_cursor.h"
#include "scene/gltf/load/load_sky.h"
#include "scene/gltf/load/loader.h"
#include "scene/gltf/load/scale_document.h"
#include "scene/measured_brdf.h"
#include "scene/pose.h"
#include "scene/settle_sides.h"

namespace prelight {

namespace {

std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += fmt::format("{}{} \"{}\"", i == 0 ? "" : ", ", i, names[i]);
  return list;
}

/// Makes a scene, given by number or name, the default one.
void chooseScene(GltfDocument& document, const std::string& chosen) {
  if (chosen.empty()) return;
  std::vector<std::string> names;
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  root.forEachObject(
      "scenes", [&](const JsonCursor& scene, std::size_t) { names.push_back(scene.stringOr("name", "")); });
  const std::string place = fmt::format("LoadOptions::scene {}", chosen);
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != chosen) continue;
    if (found)
      throw UsageError(place, "several have that name", "give its number: the file has " + listOf(names));
    found = i;
  }
  for (std::size_t i = 0; !found && i < names.size(); ++i)
    if (std::to_string(i) == chosen) found = i;
  if (!found)
    throw UsageError(place, "there is none with that name or number",
                     names.empty() ? "the file has no scenes" : "the file has " + listOf(names));
  document.json["scene"] = *found;
}

std::string nameOfScene(const GltfDocument& document, std::size_t index) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  if (index >= root.countOf("scenes")) return fmt::format("scene {}, which the file no longer has", index);
  const std::string name = root.at("scenes").at(index).stringOr("name", "");
  return name.empty() ? fmt::format("scene {}", index) : fmt::format("scene {} \"{}\"", index, name);
}

/// Removes the bake of another scene than the chosen one. `before` is the file's default scene.
void leaveOutOtherScenes(GltfDocument& document, const RecordedChoice& recorded, std::size_t before,
                         Warnings& warnings) {
  const std::string file = document.path.string();
  const std::size_t baked = recorded.scene.value_or(before);
  const std::size_t chosen = JsonCursor(file, document.json).unsignedOr("scene", 0);
  if (!recorded.baked || baked == chosen) return;
  warnings.push_back(fmt::format("{}: its bake was made of {}, not of {}, and is left out", file,
                                 nameOfScene(document, baked), nameOfScene(document, chosen)));
  stripBake(document);
}

std::string nameOfMoment(const std::optional<SceneMoment>& moment) {
  return moment ? fmt::format("{:g} s of animation {}", moment->seconds, moment->animation) : "rest";
}

bool hasVariant(const GltfDocument& document, const std::string& name) {
  const std::string file = document.path.string();
  const auto extensions = JsonCursor(file, document.json).find("extensions");
  const auto variants = extensions ? extensions->find("KHR_materials_variants") : std::nullopt;
  bool has = false;
  if (variants)
    variants->forEachObject("variants", [&](const JsonCursor& variant, std::size_t) {
      has = has || variant.stringOr("name", "") == name;
    });
  return has;
}

/// Returns the requested variant, else the one that was baked.
std::string chooseVariant(const GltfDocument& document, const LoadOptions& options,
                          const RecordedChoice& recorded, Warnings& warnings) {
  const std::string baked =
      recorded.variant.empty() ? "its own materials" : fmt::format("variant \"{}\"", recorded.variant);
  if (!options.variant.empty()) {
    if (recorded.baked && options.variant != recorded.variant)
      warnings.push_back(fmt::format("{}: its bake was made of {}", document.path.string(), baked));
    return options.variant;
  }
  if (recorded.variant.empty() || hasVariant(document, recorded.variant)) return recorded.variant;
  warnings.push_back(
      fmt::format("{}: /extensions/PRELIGHT_transfer/variant: its bake was made of {}, which the file no "
                  "longer has; it is shown in its own materials",
                  document.path.string(), baked));
  return "";
}

/// Poses the scene. Returns false if it stays at rest.
bool poseAsChosen(Scene& scene, const LoadOptions& options, const RecordedChoice& recorded,
                  const std::string& file, Warnings& warnings) {
  if (options.at) {
    setPose(scene, options.animation.empty() ? 0 : findAnimation(scene, options.animation), *options.at);
    const bool same = recorded.moment && recorded.moment->animation == scene.moment->animation &&
                      recorded.moment->seconds == scene.moment->seconds;
    if (recorded.baked && !same && recorded.played != scene.moment->animation)
      warnings.push_back(fmt::format("{}: its bake was made at {}, not at {}", file,
                                     nameOfMoment(recorded.moment), nameOfMoment(scene.moment)));
  } else if (recorded.moment) {
    setPose(scene, recorded.moment->animation, recorded.moment->seconds);
  }
  return options.at || recorded.moment;
}

void scaleAsAsked(GltfDocument& document, double scale, RecordedChoice& recorded, Warnings& warnings) {
  if (scale == 1.0) return;
  if (recorded.baked) {
    warnings.push_back(fmt::format("{}: its bake was made of the scene in its own size and is left out",
                                   document.path.string()));
    stripBake(document);
    recorded.baked = false;
  }
  scaleDocument(document, scale);
}

}  // namespace

LoadedScene openScene(const std::function<GltfDocument(Warnings&)>& read, const LoadOptions& options,
                      Steps& steps) {
  requireRanges(options);
  const auto document = std::make_shared<GltfDocument>();
  LoadedScene opened;
  opened.document = document;
  Warnings& warnings = opened.warnings;
  RecordedChoice recorded;
  Warnings said;  // the same warnings were given for the scene at rest
  steps.run("load", [&] {
    *document = read(warnings);
    steps.progress().check();
    const std::string file = document->path.string();
    const std::size_t before = JsonCursor(file, document->json).unsignedOr("scene", 0);
    chooseScene(*document, options.scene);
    leaveOutOtherScenes(*document, readRecordedChoice(*document), before, warnings);
    recorded = readRecordedChoice(*document);
    scaleAsAsked(*document, options.scale, recorded, warnings);
    const std::string variant = chooseVariant(*document, options, recorded, warnings);
    opened.scene = loadScene(*document, warnings, variant);
    giveMeasured(opened.scene, options.brdfs, warnings);
    if (auto sky = loadSky(*document, warnings))
      opened.sky = std::make_shared<const Environment>(*std::move(sky));
  });
  opened.path = document->path;
  steps.run("compile", [&] {
    // Sides are determined at rest, so that they are the same in all poses.
    opened.compiled = settleSides(opened.scene, warnings);
    if (poseAsChosen(opened.scene, options, recorded, document->path.string(), warnings))
      opened.compiled = compileScene(opened.scene, said);
  });
  return opened;
}

GltfDocument& ownDocument(LoadedScene& scene) {
  if (scene.document.use_count() > 1) scene.document = std::make_shared<GltfDocument>(*scene.document);
  // openScene() made it as an object that is not const.
  return const_cast<GltfDocument&>(*scene.document);
}

LoadedScene loadDocument(const std::function<GltfDocument(Warnings&)>& read, const LoadOptions& options) {
  Progress ignored;
  Steps steps(ignored);
  return openScene(read, options, steps);
}

void requireTriangles(const std::filesystem::path& path, const CompiledScene& scene, const char* use) {
  if (scene.triangleCount() > 0) return;
  const std::string dropped =
      scene.droppedTriangles == 0 ? "" : fmt::format(", only {} of zero area", scene.droppedTriangles);
  throw InputError(path.string(),
                   fmt::format("the scene has no triangles{}; there is nothing {}", dropped, use),
                   "export meshes along with it");
}

LoadedScene load(const std::filesystem::path& path, const LoadOptions& options) {
  return loadDocument(
      [&](Warnings& warnings) { return readGltf(path, warnings, {.allowOutside = options.allowOutside}); },
      options);
}

LoadedScene load(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                 const LoadOptions& options) {
  const std::span<const std::uint8_t> text(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  return loadDocument(
      [&](Warnings& warnings) {
        return parseGltf(text, folder / "memory", warnings, {options.allowOutside});
      },
      options);
}

LoadedScene loadBuiltin(const std::string& name) {
  return loadDocument([&](Warnings&) { return makeBuiltinScene(name); }, {});
}

std::optional<Bake> carriedBake(const LoadedScene& scene) {
  return readBake(*scene.document, scene.compiled);
}

}  // namespace prelight
