#include <optional>

#include "base/atomic_file.h"
#include "io/baked_file.h"
#include "io/baked_strip.h"
#include "io/finite_results.h"
#include "io/values/transfer_extension.h"
#include "library/compress_bake.h"
#include "prelight/load.h"
#include "prelight/save_compressed.h"
#include "techniques/light_map/light_map_file.h"
#include "scene/gltf/extension_names.h"
#include "scene/gltf/glb_output.h"
#include "scene/vertex_surface.h"

namespace prelight {

namespace {

void requireGlb(const std::filesystem::path& path) {
  if (path.extension() != ".glb")
    throw UsageError(path.string(), "a scene is written as .glb, got '" + path.extension().string() + "'");
}

void writeBake(const std::filesystem::path& path, const LoadedScene& scene, const Bake& bake,
               const QuantizedOccluders* occluders) {
  requireGlb(path);
  GltfDocument document = *scene.document;
  embedBake(document, scene.compiled, bake, occluders);
  OutputFiles files;
  // The picture is written before the file that refers to it.
  if (bake.lightMap) {
    const std::filesystem::path picture = lightMapPath(path);
    requireFiniteLightMap(picture, *bake.lightMap);
    addLightMap(files, picture, *bake.lightMap);
    embedLightMap(document, scene.compiled, bake.lightMap->layout, picture.filename().string());
  }
  addGlb(files, path, document);
  files.commit();
}

}  // namespace

void save(const std::filesystem::path& path, const LoadedScene& scene) {
  requireGlb(path);
  GltfDocument document = *scene.document;
  stripBake(document);
  dropExtensionName(document.json, transferExtensionName);
  OutputFiles files;
  addGlb(files, path, document);
  files.commit();
}

void save(const std::filesystem::path& path, const LoadedScene& scene, const Bake& bake) {
  writeBake(path, scene, bake, nullptr);
}

std::vector<std::string> saveCompressed(const std::filesystem::path& path, const LoadedScene& scene,
                                        const Bake& bake, const FileCompression& compression) {
  if (compression.transfer && !bake.sh)
    throw UsageError("FileCompression::transfer", "it compresses SH transfer, and the bake has none",
                     "bake with ShRequest::order");
  if (compression.occluders && !bake.occluders)
    throw UsageError("FileCompression::occluders", "the bake has no vector occluders",
                     "bake with BakeRequest::occluders");
  Bake small = bake;
  std::vector<std::string> notes;
  std::optional<QuantizedOccluders> quantized;
  if (compression.transfer)
    notes = compressTransfer(*compression.transfer, surfaceOfVertices(scene.compiled), small);
  if (compression.occluders) quantized = quantizeBaked(scene.compiled, small, notes);
  writeBake(path, scene, small, quantized ? &*quantized : nullptr);
  return notes;
}

}  // namespace prelight
