#include "library/save.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "base/atomic_file.h"
#include "compress/compress.h"
#include "compress/compressed_parts.h"
#include "compress/compression_error.h"
#include "io/baked_file.h"
#include "io/baked_strip.h"
#include "io/finite_results.h"
#include "io/values/value_reader.h"
#include "prelight/load.h"
#include "prelight/save_compressed.h"
#include "scene/deform.h"
#include "scene/gltf/gltf_document.h"
#include "techniques/light_map/light_map_file.h"
#include "techniques/registry/registry.h"

namespace prelight {

namespace {

std::string compressVertices(const CompressionRequest& compression, std::span<const double> surface,
                             Bake& bake, const Progress& progress) {
  const HarmonicTransfer full = std::move(*bake.sh);
  bake.sh.reset();
  bake.compressedSh = compress(full, compression, surface, progress);
  const CompressionError error = compressionError(full, decompress(*bake.compressedSh), surface);
  const double bytes = static_cast<double>(bake.compressedSh->byteCount());
  return fmt::format(
      "compression {}: {:.1f} bytes per vertex instead of {}, error of the light {:.2g} rms over a few "
      "lights, {:.2g} for the worst",
      compressionName(compression), bytes / bake.compressedSh->vertexCount,
      4 * full.channels * full.order * full.order, error.lightingRms, error.worstLightingRms);
}

std::string textOf(const CompressionRequest& compression, const PartCompression& part) {
  if (part.bytes == part.floatBytes)
    return fmt::format("compression of the {}: none, because {} would take more than their {} bytes",
                       part.part, compressionName(compression), part.floatBytes);
  return fmt::format("compression of the {}: {} bytes instead of {}, error of coefficients {:.2g} rms",
                     part.part, part.bytes, part.floatBytes, part.error);
}

}  // namespace

namespace {

/// Compresses all SH transfer of a bake, which holds some. `surface` is the area of each vertex.
void compressTransfer(const CompressionRequest& compression, std::span<const double> surface, Bake& bake,
                      std::vector<std::string>& notes, const Progress& progress) {
  notes.push_back(compressVertices(compression, surface, bake, progress));
  for (const PartCompression& part : compressParts(compression, surface, bake, progress))
    notes.push_back(textOf(compression, part));
}

/// Returns the method with a byte per coefficient that has the smaller error of the light.
CompressionRequest betterBytes(const HarmonicTransfer& transfer, std::span<const double> surface,
                               const Progress& progress) {
  const auto errorOf = [&](CompressionMethod method) {
    const CompressedTransfer compressed = compress(transfer, {.method = method}, surface, progress);
    return compressionError(transfer, decompress(compressed), surface).lightingRms;
  };
  const double band8 = errorOf(CompressionMethod::Band8), rgbe = errorOf(CompressionMethod::Rgbe);
  return {.method = band8 <= rgbe ? CompressionMethod::Band8 : CompressionMethod::Rgbe};
}

/// Returns the quantised occluders of a bake, which holds some, and replaces them by the decoded ones.
QuantizedOccluders quantizeBaked(const CompiledScene& scene, Bake& bake, std::vector<std::string>& notes) {
  std::vector<glm::dvec3> vertices;
  for (const glm::vec3& position : scene.positions) vertices.push_back(scene.origin + glm::dvec3(position));
  QuantizedOccluders quantized = quantizeOccluders(*bake.occluders, vertices);
  OccluderTransfer read = dequantizeOccluders(quantized, vertices);
  const OccluderQuantizationError error = quantizationError(*bake.occluders, read, vertices, scene.normals);
  bake.occluders = std::move(read);
  notes.push_back(
      fmt::format("compression of vector occluders: {} bytes per record instead of {}, error of the light "
                  "{:.2g} rms, of form factors {:.2g} at most",
                  quantizedBytes(quantized.stored), quantized.stored.size() * sizeof(glm::vec4), error.light,
                  error.formFactor));
  return quantized;
}

}  // namespace

StoredForms compressBake(const FileCompression& compression, const CompiledScene& scene, Bake& bake,
                         std::vector<std::string>& notes, const Progress& progress) {
  StoredForms forms{.columns = compression.everything};
  const std::vector<double> surface = surfaceOfVertices(scene);
  if (bake.sh && (compression.transfer || compression.everything))
    compressTransfer(compression.transfer ? *compression.transfer : betterBytes(*bake.sh, surface, progress),
                     surface, bake, notes, progress);
  for (const Technique& technique : techniques())
    if (compression.everything && technique.file.addForms != nullptr)
      technique.file.addForms({bake, surface, progress}, forms, notes);
  if (bake.occluders && (compression.occluders || compression.everything))
    forms.occluders = quantizeBaked(scene, bake, notes);
  return forms;
}

void decodeStored(const GltfDocument& document, const CompiledScene& scene, const StoredForms& forms,
                  Bake& bake) {
  if (!forms.columns) return;
  GltfDocument stored = document;
  // Moments are not read back: their near lamps would have no animation to belong to.
  std::optional<AnimatedTransfer> animation = std::exchange(bake.animation, std::nullopt);
  embedBake(stored, scene, bake, &forms);
  Bake read = readQuantizedParts(stored, scene);
  takeBake(bake, std::move(read));
  bake.animation = std::move(animation);
}

std::vector<std::string> savingsTexts(const SavingsByColumn& saved) {
  std::vector<std::string> texts;
  for (const auto& [name, column] : saved)
    texts.push_back(fmt::format("compression of {}: {} bytes instead of {}, error {:.2g} rms", name,
                                column.bytes, column.plainBytes, column.error()));
  return texts;
}

namespace {

void requireGlb(const std::filesystem::path& path) {
  if (path.extension() != ".glb")
    throw UsageError(path.string(), "a scene is written as .glb, got '" + path.extension().string() + "'");
}

SavingsByColumn writeBake(const std::filesystem::path& path, const LoadedScene& scene, const Bake& bake,
                          const StoredForms* forms) {
  requireGlb(path);
  GltfDocument document = *scene.document;
  SavingsByColumn saved = embedBake(document, scene.compiled, bake, forms);
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
  return saved;
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
  const StoredForms forms = compressBake(compression, scene.compiled, small, notes);
  const std::vector<std::string> columns = savingsTexts(writeBake(path, scene, small, &forms));
  notes.insert(notes.end(), columns.begin(), columns.end());
  return notes;
}

}  // namespace prelight
