#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "export/export_request.h"
#include "export/exported_meshes.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "projectors/ambient_occlusion/occlusion_map.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// What is exported.
struct ExportedScene {
  GltfDocument document;  ///< of the baked file
  const Scene& scene;
  const CompiledScene& compiled;
  const Bake& bake;
  const Environment* sky = nullptr;     ///< to be the scene's, for ExportTarget::Gltf
  const LightMap* occlusion = nullptr;  ///< of ExportForm::Occlusion: accessibility of texels, 0..1
};

/// A file of an export: where, and what is in it.
struct ExportedFile {
  std::string name;
  std::string contents;     ///< for people
  std::uint64_t bytes = 0;  ///< known when all are complete
};

struct ExportReport {
  std::vector<ExportedFile> files;
  ExportedMeshes meshes;
  std::size_t lights = 0;  ///< of the scene's nodes
  std::size_t skyPictures = 0;
  int mapWidth = 0, mapHeight = 0;
  int mapPictures = 0;                               ///< of 8 bits, in the scene's file
  float largest = 0.0f;                              ///< irradiance of the light map, W/m2
  bool directions = false;                           ///< the light map tells where its light comes from
  std::optional<OcclusionMapReport> occlusion = {};  ///< where the map was cast for the export
};

/// What is there to be handed on, where nobody says.
ExportForm usualForm(const Bake& bake, ExportTarget target);

/// Throws UsageError for a form that is not written for a target.
void requireTarget(ExportForm form, ExportTarget target);

/// Throws UsageError for a form that the bake holds nothing for.
void requireForm(const Bake& bake, ExportForm form);

/// The map of ExportForm::Occlusion: occlusion within the limits of the bake, cast at the texels of charts
/// that are made for it. `rays`: a texel, a power of two, 16 to 8192. Throws as makeOcclusionMap().
LightMap occlusionForExport(const Scene& scene, const CompiledScene& compiled, const Bake& bake,
                            std::uint32_t rays, const Device& device, Progress& progress,
                            OcclusionMapReport& report);

/// Writes an ordinary glTF file that others show as it was baked, with what it needs: `output` is a .glb,
/// which holds all of it, or a folder, made where its last part is missing, for a .glb, its light map in
/// every form that the target reads, a description (NAME.export.json) and a README. All files appear
/// together. Throws UsageError for a form that the bake holds nothing for, or that is of points in the air.
ExportReport exportBake(ExportedScene exported, const std::filesystem::path& output, const std::string& name,
                        const ExportRequest& request);

/// The report for programs, and the description beside the files.
nlohmann::ordered_json toJson(const ExportReport& report, const ExportRequest& request);

}  // namespace prelight
