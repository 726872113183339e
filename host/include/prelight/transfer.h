#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace prelight {

/// Diffuse transfer of every vertex in spherical or cpherical harmonics. For SH, T_i = (1/pi) integral V
/// max(n.w,0) Y_i dw plus bounces; the receiver's albedo is not included, so exit radiance = albedo x sum L_i
/// T_i. CH coefficients are those with sum_i T_i C_i = sum_i T_i^SH Y_i (docs/bases.md).
struct HarmonicTransfer {
  int order = 0;     ///< bands 0..order-1, order^2 coefficients
  int channels = 1;  ///< 3 with bounces, 1 without
  int bounces = 0;
  std::vector<float> coefficients;  ///< [vertex][channel][i]
  bool naive = false;               ///< CH: inner products <T, C_i> in place of coefficients
};

/// Horizon of every vertex in sectors of azimuth around its normal: sector s lies between the turns 2 pi s /
/// sectors and 2 pi (s + 1) / sectors from the tangent to the bitangent of surfaceFrame(normal). What lies
/// between a foot and its horizon is closed, and so much of a cosine-weighted sky as the sector has, cos^2 of
/// the horizon and sin^2 of the foot, is open.
struct HorizonTransfer {
  int sectors = 0;
  std::vector<float> angles;     ///< [vertex][sector], of horizons: radians above the tangent plane, 0..pi/2
  std::vector<float> feet = {};  ///< [vertex][sector], up to the horizon's; none: all are 0
};

/// What blocks light before some distance, of every vertex: shell k has, in SH, the part (1/pi) integral
/// max(n.w,0) Y_i dw of the directions whose first surface lies in it. Shells share the distances from
/// `nearest` to `farthest` evenly by their logarithm; the first has what is nearer, too, and the last what is
/// farther. Without bounces, so that colours do not matter.
struct NearLampTransfer {
  int order = 0;
  int shells = 0;
  double nearest = 0.0;  ///< m
  double farthest = 0.0;
  std::vector<std::uint16_t> halves;  ///< [vertex][shell][i], IEEE half

  std::size_t columns() const { return static_cast<std::size_t>(order * order); }
};

/// Diffuse SH transfer at the texels of charts: HarmonicTransfer's, with the texel's
/// own normal where the surface has a normal map.
struct ChartTransfer {
  struct Map {
    std::size_t primitive = 0;  ///< into CompiledScene::primitives
    int width = 0;
    int height = 0;
    std::vector<glm::vec2> coords;    ///< [vertex of the primitive], in [0,1]^2; row 0 is at v = 0
    std::vector<float> coefficients;  ///< [row][column][channel][i]; off the surface, those of what is next

    std::size_t texels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  };
  int order = 0;
  int channels = 1;  ///< 3 with bounces, 1 without
  int bounces = 0;
  std::vector<Map> maps;  ///< ascending by primitive; at most one a primitive

  /// Coefficients a texel.
  std::size_t rowLength() const { return static_cast<std::size_t>(order * order * channels); }
};

/// Transfer at moments of an animation, in world space as the nodes stand then. Between them it is
/// interpolated.
struct AnimatedTransfer {
  std::size_t animation = 0;           ///< in the glTF file
  std::vector<double> times;           ///< [key], seconds, >= 0, strictly ascending, never empty
  std::vector<HarmonicTransfer> keys;  ///< [key], of one order, number of channels and of bounces
};

/// Diffuse transfer of every vertex in Haar wavelets on the faces of a cube map (docs/wavelets.md), sparse.
/// The solid angle of texels is in the transfer, so that exit radiance = albedo x sum L_i T_i with L the
/// transformed radiance of the texels. A row belongs to a vertex and a channel.
struct HaarTransfer {
  int faceSize = 0;  ///< texels, a power of two
  int channels = 1;  ///< 3 with bounces, 1 without
  int bounces = 0;
  std::vector<std::uint32_t> offsets;  ///< [vertex * channels + channel], then the end
  std::vector<std::uint32_t> indices;  ///< ascending within a row, below 6 faceSize^2
  std::vector<float> values;           ///< parallel to indices

  /// Bytes of an index in a file: two wherever they tell the texels of six faces apart.
  std::size_t storedIndexBytes() const { return 6 * faceSize * faceSize <= 0x10000 ? 2 : 4; }
};

/// What arrives on the other side of surfaces that let light through diffusely, within a body on its inner
/// side, in the forms of what arrives on their fronts. With T that of fronts and B this, a front's exit
/// radiance is albedo x sum L_i T_i + transmission x sum L_i B_i, and a back's has T and B exchanged. 0 at
/// the vertices of all other surfaces.
struct ThroughTransfer {
  std::vector<float> ao;  ///< [vertex], accessibility; or empty
  std::optional<HarmonicTransfer> sh;
  std::optional<HarmonicTransfer> ch;
  std::optional<HaarTransfer> haar;  ///< of SH of the bands that bounces have
};

/// Transfer matrices of glossy receivers: M_ij = (1/pi) integral V max(n.w,0) Y_i Y_j dw plus bounces. With
/// light L_j, sum_j M_ij L_j are the SH coefficients of the incident radiance times visibility and cosine
/// over pi.
struct GlossyTransfer {
  int order = 0;     ///< bands of both sides; order^4 entries
  int channels = 1;  ///< 3 with bounces, 1 without
  int bounces = 0;
  std::vector<float> matrices;  ///< [vertex][channel][i][j]
};

/// What a record of vector occluders may hold (Sherif 2013, 7.2). xyz, and w.
enum class OccluderVector : std::uint8_t {
  Position,        ///< mean of the part that is seen, world space; mean distance, m
  Occlusion,       ///< form-factor weighted sum of directions; form factor
  Caustic,         ///< the same of directions after refraction; form factor
  Transmissive,    ///< mean colour that comes through; 0
  DiffuseNormal,   ///< sum of normals weighted by form factor and their AO; sum of the weights
  DiffuseColor,    ///< mean diffuse colour; 0
  SpecularNormal,  ///< sum of normals whose reflection is open, weighted by form factor; sum of the weights
  SpecularColor,   ///< mean specular colour; 0
};

constexpr std::array<std::string_view, 8> occluderVectorNames = {
    "position",      "occlusion",    "caustic",        "transmissive",
    "diffuseNormal", "diffuseColor", "specularNormal", "specularColor"};

/// What every vertex sees of every occluder: a sparse row of records a vertex.
struct OccluderTransfer {
  std::vector<std::string> names;        ///< [occluder]
  std::vector<OccluderVector> stored;    ///< of a record, ascending
  std::vector<std::uint32_t> offsets;    ///< [vertex] into the records, then the end
  std::vector<std::uint32_t> occluders;  ///< [record], ascending within a vertex
  std::vector<glm::vec4> vectors;        ///< [record][stored]

  std::size_t recordCount() const { return occluders.size(); }
};

/// Lights that are scaled and coloured together at run time.
struct LightGroup {
  std::string name;
  glm::vec3 color{
      1.0f};  ///< intensity in the file (W/sr, W/m2, W/(m2 sr)): the greatest of its lights a channel
};

/// Light of the scene's own emitters at every vertex, with shadows and bounces: exit radiance of channel c is
/// albedo[c] x sum_g color_g[c] T[vertex][c][g], whatever colours the groups are given.
struct LightGroupTransfer {
  std::vector<LightGroup> groups;
  int channels = 1;
  int bounces = 0;
  std::vector<float>
      coefficients;  ///< [vertex][channel][group], per unit of the group's colour; 1/pi is in it
};

/// A grid of cubic cells, in world space. Values belong to the cells' centres.
struct VolumeGrid {
  glm::ivec3 size{0};  ///< cells along x, y, z
  glm::dvec3 min{0.0};
  glm::dvec3 max{0.0};

  std::size_t count() const {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
  }
  double cell() const { return (max.x - min.x) / size.x; }
};

/// Transfer of points in the air: the mean over all directions of what arrives, T_i = (1/(4 pi)) integral V
/// Y_i dw, plus light that the surfaces in view reflect. The mean radiance at a point is sum L_i T_i: what a
/// medium that scatters evenly takes in.
struct VolumeTransfer {
  VolumeGrid grid;
  int order = 0;
  int channels = 1;                 ///< 3 with bounces, 1 without
  int bounces = 0;                  ///< diffuse reflections at surfaces
  std::vector<float> coefficients;  ///< [z][y][x][channel][i]
  std::vector<float> direct;        ///< [z][y][x][i], without bounces; empty: `coefficients` are
  std::vector<std::uint8_t> air;    ///< [z][y][x], 0: inside a closed object, where every ray meets a back

  /// What surfaces in view send, by the direction that it comes from: SH of their radiance, integral L Y_j
  /// dw, for objects that move through the volume. Empty: not kept.
  int sentOrder = 0;
  std::vector<float> sent = {};  ///< [z][y][x][channel 3][j][i], a light's coefficient i

  /// The same of the scene's own lights, after one reflection or more, per unit of a group's colour. Groups
  /// are those of Bake::lightGroups. Empty: not kept.
  int lightOrder = 0;
  std::vector<float> lights = {};  ///< [z][y][x][channel 3][j][group]

  std::size_t columns() const { return static_cast<std::size_t>(order * order); }
  std::size_t sentBands() const { return static_cast<std::size_t>(sentOrder * sentOrder); }
  std::size_t lightBands() const { return static_cast<std::size_t>(lightOrder * lightOrder); }
  std::size_t groups() const {
    return lights.empty() ? 0 : lights.size() / (grid.count() * 3 * lightBands());
  }
};

/// A volume's transfer at a point.
struct VolumeSample {
  int order = 0;
  std::array<std::vector<double>, 3> coefficients;  ///< [channel][i], alike without bounces
  std::vector<double> direct;                       ///< [i]
};

/// Trilinear between the centres of cells, constant beyond them. Cells inside objects are left out, unless
/// nothing else is near: they would darken what is next to the object.
VolumeSample sampleVolume(const VolumeTransfer& volume, const glm::dvec3& position);

/// Mean radiance over all directions, sum L_i T_i. `light` holds [channel][i] for at least the sample's
/// order, `lightColumns` a channel.
glm::dvec3 meanRadiance(const VolumeSample& sample, std::span<const double> light, std::size_t lightColumns);

/// How transfer is made smaller (docs/compression.md).
enum class CompressionMethod : std::uint8_t {
  Half,   ///< IEEE half floats
  Band8,  ///< 8 bits with an offset and a scale a band and channel (Staniszewski 2005, 3.2)
  Pca,    ///< a mean and principal components of all vertices
  Vq,     ///< vector quantisation: every vertex takes the mean of its cluster
  Cpca,   ///< clusters with components of their own (Sloan, Hall, Hart and Snyder 2003)
  Rgbe,   ///< 8 bits and an exponent a vertex and band (Staniszewski 2005, 3.2)
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
///   Rgbe   T[v][c][i] = (bytes[v][c][i] - 128) / 128 x 2^(exponents[v][l] - 128), 0 for the exponent 0
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

  std::vector<std::uint16_t> halves;    ///< Half: [vertex][channel][i], IEEE half
  std::vector<std::uint8_t> bytes;      ///< Band8, Rgbe: [vertex][channel][i]
  std::vector<std::uint8_t> exponents;  ///< Rgbe: [vertex][band]
  std::vector<float> ranges;            ///< Band8: [channel][band][offset, scale]

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
  /// Bytes of all arrays together.
  std::size_t byteCount() const;
};

/// What stands in a file for SH transfer beside that of vertices; a reader's floats are what it decodes to.
struct CompressedParts {
  std::optional<CompressedTransfer> texels;        ///< of all charts, [map][row][column]
  std::optional<CompressedTransfer> keys;          ///< of an animation, [key][vertex]
  std::optional<CompressedTransfer> volume;        ///< VolumeTransfer::coefficients, [z][y][x]
  std::optional<CompressedTransfer> volumeDirect;  ///< VolumeTransfer::direct
  std::optional<CompressedTransfer> volumeSent;    ///< VolumeTransfer::sent, a channel for each [channel][j]
};

/// "half", "band8", "rgbe", "pca:K", "vq:N" or "cpca:N:K" (N clusters, K components), the last three with
/// weights of 32, 16 or 8 bits: "cpca:64:8:float", ":half" (the default) or ":byte". Throws UsageError.
CompressionRequest parseCompression(std::string_view text);

/// What parseCompression reads.
std::string compressionName(const CompressionRequest& request);

/// Compresses a scene's transfer. `vertexWeights`, [vertex] >= 0, says how much each vertex's error counts
/// (the surface that it stands for); empty: all alike. The result depends on the arguments
/// alone, not on the number of threads. Throws UsageError for more components than a vector is long,
/// InputError for transfer that is not finite or does not have order^2 coefficients a channel.
CompressedTransfer compress(const HarmonicTransfer& transfer, const CompressionRequest& request,
                            std::span<const double> vertexWeights = {});

HarmonicTransfer decompress(const CompressedTransfer& compressed);

}  // namespace prelight
