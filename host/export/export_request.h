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
#include "base/suggestion.h"
#include "prelight/error.h"

namespace prelight {

/// Who the exported files are for.
enum class ExportTarget : std::uint8_t {
  Gltf,     ///< programs that are not named here: every file that there is
  Three,    ///< three.js
  Blender,  ///< Blender
  Raw,      ///< programs of one's own: numbers and JSON that says what they are
  Godot,    ///< Godot 4
  Unity,    ///< Unity with glTFast
};

constexpr std::array<std::string_view, 6> exportTargetNames = {"gltf", "three", "blender",
                                                               "raw",  "godot", "unity"};

/// How other programs get what was baked.
enum class ExportForm : std::uint8_t {
  LightMap,         ///< irradiance of the scene's own lights, in a map
  Occlusion,        ///< ambient occlusion in a map, the materials' occlusionTexture
  VertexLight,      ///< irradiance as the colours of vertices, on unlit materials
  VertexOcclusion,  ///< ambient occlusion as the colours of vertices, which darken the material's
  Probes,           ///< irradiance of the scene's own lights at points in the air
  Volume,           ///< transfer of points in the air
  Transfer,         ///< transfer of vertices as numbers, beside the scene as it is: of ExportTarget::Raw
};

constexpr std::array<std::string_view, 7> exportFormNames = {
    "lightmap", "occlusion", "vertex-light", "vertex-occlusion", "probes", "volume", "transfer"};

/// Whether it is of points in the air, without the scene.
constexpr bool isOfAir(ExportForm form) { return form == ExportForm::Probes || form == ExportForm::Volume; }

/// Whether the scene's own lights are in it.
constexpr bool holdsLight(ExportForm form) {
  return form == ExportForm::LightMap || form == ExportForm::VertexLight;
}

/// What becomes of lights whose light is baked.
enum class BakedLights : std::uint8_t {
  Remove,  ///< the exported scene has none
  Mark,    ///< extras.prelight.baked says so
  Keep,    ///< as they are
};

constexpr std::array<std::string_view, 3> bakedLightsNames = {"remove", "mark", "keep"};

/// What is made of a baked scene for other programs.
struct ExportRequest {
  ExportTarget target = ExportTarget::Gltf;
  ExportForm form = ExportForm::LightMap;
  BakedLights lights = BakedLights::Remove;
  bool dryRun = false;  ///< nothing is written
};

/// The value that `name` stands for among the names of an enumeration, in its order. Throws UsageError about
/// what it was given by.
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
