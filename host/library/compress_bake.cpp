#include "library/compress_bake.h"

#include <fmt/format.h>

#include <utility>

#include "compress/compress.h"
#include "compress/compressed_parts.h"
#include "compress/compression_error.h"

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

std::vector<std::string> compressTransfer(const CompressionRequest& compression,
                                          std::span<const double> surface, Bake& bake,
                                          const Progress& progress) {
  std::vector<std::string> notes = {compressVertices(compression, surface, bake, progress)};
  for (const PartCompression& part : compressParts(compression, surface, bake, progress))
    notes.push_back(textOf(compression, part));
  return notes;
}

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

}  // namespace prelight
