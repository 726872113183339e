#pragma once

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/atomic_file.h"
#include "base/text.h"
#include "prelight/error.h"

namespace prelight {

/// The program that the exported files are for.
enum class ExportTarget : std::uint8_t {
  Gltf,   ///< any other program: files in every format
  Three,  ///< three.js
  Blender,
  Raw,    ///< own programs: raw arrays with a JSON description
  Godot,  ///< Godot 4
  Unity,  ///< Unity with glTFast
};

constexpr std::array<std::string_view, 6> exportTargetNames = {"gltf", "three", "blender",
                                                               "raw",  "godot", "unity"};

/// The form in which other programs receive the baked data.
enum class ExportForm : std::uint8_t {
  LightMap,         ///< irradiance of the scene's own lights, in a map
  Occlusion,        ///< ambient occlusion in a map, the materials' occlusionTexture
  VertexLight,      ///< irradiance as vertex colours, on unlit materials
  VertexOcclusion,  ///< ambient occlusion as vertex colours, which darken the material's
  Probes,           ///< irradiance of the scene's own lights at points in the air
  Volume,           ///< transfer at points in the air
  Transfer,  ///< transfer of vertices with the unchanged scene: within it for Three, beside it as arrays for
             ///< Raw
};

constexpr std::array<std::string_view, 7> exportFormNames = {
    "lightmap", "occlusion", "vertex-light", "vertex-occlusion", "probes", "volume", "transfer"};

/// Returns whether a form holds points in the air, without the scene.
constexpr bool isOfAir(ExportForm form) { return form == ExportForm::Probes || form == ExportForm::Volume; }

/// Returns whether a form includes the light of the scene's own lights.
constexpr bool holdsLight(ExportForm form) {
  return form == ExportForm::LightMap || form == ExportForm::VertexLight;
}

/// Treatment of lights whose light is baked.
enum class BakedLights : std::uint8_t {
  Remove,  ///< lights are removed
  Mark,    ///< extras.prelight.baked marks them
  Keep,    ///< lights stay unchanged
};

constexpr std::array<std::string_view, 3> bakedLightsNames = {"remove", "mark", "keep"};

/// How a baked scene is exported.
struct ExportRequest {
  ExportTarget target = ExportTarget::Gltf;
  ExportForm form = ExportForm::LightMap;
  BakedLights lights = BakedLights::Remove;
  bool dryRun = false;  ///< no file is written
};

/// Returns the value of an enumeration with the given name, in the order of `names`. Throws UsageError that
/// begins with `given`, the option of the name.
template <class Enumeration, std::size_t count>
Enumeration exportNamed(const std::string& given, const std::string& name,
                        const std::array<std::string_view, count>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    const std::vector<std::string> known(names.begin(), names.end());
    throw UsageError(given + " " + name, "unknown name",
                     didYouMean(name, known) + fmt::format("expected one of {}", fmt::join(known, ", ")));
  }
  return static_cast<Enumeration>(found - names.begin());
}

constexpr FileWork workOf(const ExportRequest& request) {
  return request.dryRun ? FileWork::Count : FileWork::Write;
}

}  // namespace prelight
