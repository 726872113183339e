#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "export/export_request.h"
#include "export/exported_contents.h"
#include "export/exported_meshes.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "scene/gltf/gltf_document.h"
#include "techniques/ambient_occlusion/occlusion_map.h"

namespace prelight {

/// The baked scene to export.
struct ExportedScene {
  GltfDocument document;  ///< document of the baked file
  const Scene& scene;
  const CompiledScene& compiled;
  const Bake& bake;
  const Environment* sky = nullptr;     ///< sky that the exported scene gets, for ExportTarget::Gltf
  const LightMap* occlusion = nullptr;  ///< for ExportForm::Occlusion: accessibility per texel, 0..1
};

/// A file of an export.
struct ExportedFile {
  std::string name;
  std::string contents;     ///< description for messages
  std::uint64_t bytes = 0;  ///< known when all files are complete
};

/// Statistics of an export.
struct ExportReport {
  std::vector<ExportedFile> files;
  ExportedMeshes meshes;
  std::size_t lights = 0;  ///< number of lights on the scene's nodes
  std::size_t skyPictures = 0;
  int mapWidth = 0, mapHeight = 0;
  int mapPictures = 0;                               ///< 8-bit pictures in the scene's file
  float largest = 0.0f;                              ///< largest irradiance of the light map, W/m2
  bool directions = false;                           ///< whether the light map stores directions of light
  std::optional<OcclusionMapReport> occlusion = {};  ///< present if the map was cast for the export
  ExportedContents contents = {};
};

/// Returns the default form for what the bake holds.
ExportForm usualForm(const Bake& bake, ExportTarget target);

/// Throws UsageError for a form that is not available for a target.
void requireTarget(ExportForm form, ExportTarget target);

/// Throws UsageError for a form that the bake lacks data for.
void requireForm(const Bake& bake, ExportForm form, ExportTarget target);

/// Casts the map of ExportForm::Occlusion at the texels of charts made for it, within the occlusion limits of
/// the bake. `rays` per texel is a power of two, 16 to 8192. Throws as makeOcclusionMap().
LightMap occlusionForExport(const Scene& scene, const CompiledScene& compiled, const Bake& bake,
                            std::uint32_t rays, const Device& device, Progress& progress,
                            OcclusionMapReport& report);

/// Writes an ordinary glTF file that other programs show as baked, and the files it needs. `output` is a
/// .glb, which holds everything, or a folder, whose last component is created if missing, for a .glb, its
/// light map in every form that the target reads, a description (NAME.export.json) and a README. All files
/// appear together. Throws UsageError for a form that the bake lacks data for and for forms of points in the
/// air.
ExportReport exportBake(ExportedScene exported, const std::filesystem::path& output, const std::string& name,
                        const ExportRequest& request);

/// Returns the report as JSON, which is also the description beside the files.
nlohmann::ordered_json toJson(const ExportReport& report, const ExportRequest& request);

}  // namespace prelight
