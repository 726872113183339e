#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "transfer/transfer.h"

namespace prelight {

enum class CompressionMethod : std::uint8_t {
  Half,   ///< IEEE half floats
  Band8,  ///< 8 bits with an offset and a scale a band and channel (Staniszewski 2005, 3.2)
  Pca,    ///< a mean and principal components of all vertices
  Vq,     ///< vector quantisation: every vertex takes the mean of its cluster
  Cpca,   ///< clusters with components of their own (Sloan, Hall, Hart and Snyder 2003)
};

/// How the weights of components are stored.
enum class WeightStorage : std::uint8_t { Float, Half, Byte };

/// What to compress to. See parseCompression for the names.
struct CompressionRequest {
  CompressionMethod method = CompressionMethod::Half;
  int clusters = 1;    ///< of Vq and Cpca, 1 to 65536; at most as many as vertices are made
  int components = 0;  ///< of Pca and Cpca, 1 to channels x order^2
  WeightStorage weights = WeightStorage::Half;
  std::uint64_t seed = 1;
  int iterations = 40;  ///< of re-assignment at most, for every number of components tried
};

/// Compressed diffuse transfer. A vector holds all channels of a vertex, [channel][i], as in
/// HarmonicTransfer; D = channels x order^2 is its length. Arrays of other methods are empty.
///
///   Half   T[v][c][i] = halves[v][c][i]
///   Band8  T[v][c][i] = ranges[c][l][0] + ranges[c][l][1] x bytes[v][c][i], l the band of i
///   others T[v]       = means[k] + sum_j weight[v][j] x basis[k][j], k = clusterOf[v]
///
/// weight[v][j] is weightFloats[v][j], weightHalves[v][j] or
/// weightRanges[k][j][0] + weightRanges[k][j][1] x weightBytes[v][j], by `weights`.
struct CompressedTransfer {
  CompressionMethod method = CompressionMethod::Half;
  int order = 0;
  int channels = 1;
  int bounces = 0;
  std::uint32_t vertexCount = 0;

  std::vector<std::uint16_t> halves;  ///< Half: [vertex][channel][i], IEEE half
  std::vector<std::uint8_t> bytes;    ///< Band8: [vertex][channel][i]
  std::vector<float> ranges;          ///< Band8: [channel][band][offset, scale]

  int clusters = 0;                      ///< 1 for Pca
  int components = 0;                    ///< a cluster; 0 for Vq
  std::vector<float> means;              ///< [cluster][channel][i]
  std::vector<float> basis;              ///< [cluster][component][channel][i], orthonormal in a cluster
  std::vector<std::uint16_t> clusterOf;  ///< [vertex]; empty for Pca: all 0
  WeightStorage weights = WeightStorage::Half;
  std::vector<float> weightFloats;          ///< [vertex][component]
  std::vector<std::uint16_t> weightHalves;  ///< [vertex][component]
  std::vector<std::uint8_t> weightBytes;    ///< [vertex][component]
  std::vector<float> weightRanges;          ///< Byte: [cluster][component][offset, scale]

  std::size_t dimension() const {
    return static_cast<std::size_t>(channels) * static_cast<std::size_t>(order * order);
  }
  std::size_t cluster(std::size_t vertex) const { return clusterOf.empty() ? 0 : clusterOf[vertex]; }
  /// Weight of a component of a vertex, whatever its storage.
  double weight(std::size_t vertex, std::size_t component) const;
  /// Of all arrays together.
  std::size_t byteCount() const;
};

/// "half", "band8", "pca:K", "vq:N" or "cpca:N:K" (N clusters, K components), the last three with weights of
/// 32, 16 or 8 bits: "cpca:64:8:float", ":half" (the default) or ":byte". Throws UsageError.
CompressionRequest parseCompression(std::string_view text);

/// What parseCompression reads.
std::string compressionName(const CompressionRequest& request);

/// Compresses a scene's transfer. `vertexWeights`, [vertex] >= 0, says how much each vertex's error counts
/// (the surface it stands for, see surfaceOfVertices); empty: all alike. The result depends on the arguments
/// alone, not on the number of threads. Throws UsageError for more components than a vector is long,
/// InputError for transfer that is not finite or does not have order^2 coefficients a channel.
CompressedTransfer compress(const HarmonicTransfer& transfer, const CompressionRequest& request,
                            std::span<const double> vertexWeights = {});

HarmonicTransfer decompress(const CompressedTransfer& compressed);

}  // namespace prelight
