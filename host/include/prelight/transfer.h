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

/// Diffuse transfer per vertex in spherical or cpherical harmonics. For SH, T_i = (1/pi) integral V
/// max(n.w,0) Y_i dw plus bounces; the receiver's albedo is not included, so that exit radiance = albedo x
/// sum L_i T_i. CH coefficients satisfy sum_i T_i C_i = sum_i T_i^SH Y_i (docs/notes/bases.md).
struct HarmonicTransfer {
  int order = 0;     ///< bands 0..order-1, order^2 coefficients
  int channels = 1;  ///< 3 with bounces, 1 without
  int bounces = 0;
  std::vector<float> coefficients;  ///< [vertex][channel][i]
  bool naive = false;               ///< CH: inner products <T, C_i> in place of coefficients
};

/// Horizon per vertex in sectors of azimuth around its normal. Sector s lies between the turns 2 pi s /
/// sectors and 2 pi (s + 1) / sectors from the tangent to the bitangent of surfaceFrame(normal). Directions
/// between the sector's foot and its horizon are occluded. The open part of the sector's cosine-weighted sky
/// is cos^2 of the horizon plus sin^2 of the foot.
struct HorizonTransfer {
  int sectors = 0;
  std::vector<float> angles;     ///< [vertex][sector], horizons in radians above the tangent plane, 0..pi/2
  std::vector<float> feet = {};  ///< [vertex][sector], at most the horizon's angle; empty: all are 0
};

/// Occlusion by distance, per vertex. Shell k holds, in SH, (1/pi) integral max(n.w,0) Y_i dw over the
/// directions whose first surface lies in the shell. Shells divide the distances from `nearest` to `farthest`
/// evenly by their logarithm; the first also holds nearer surfaces and the last farther ones. Bounces are not
/// included, so that colours do not matter.
struct NearLampTransfer {
  int order = 0;
  int shells = 0;
  double nearest = 0.0;  ///< m
  double farthest = 0.0;
  std::vector<std::uint16_t> halves;  ///< [vertex][shell][i], IEEE half

  std::size_t columns() const { return static_cast<std::size_t>(order * order); }
};

/// Diffuse SH transfer at the texels of charts, like HarmonicTransfer, with the texel's own normal where the
/// surface has a normal map.
struct ChartTransfer {
  struct Map {
    std::size_t primitive = 0;  ///< into CompiledScene::primitives
    int width = 0;
    int height = 0;
    std::vector<glm::vec2> coords;  ///< [vertex of the primitive], in [0,1]^2; row 0 is at v = 0
    /// [row][column][channel][i]; texels off the surface repeat those nearby.
    std::vector<float> coefficients;

    std::size_t texels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  };
  int order = 0;
  int channels = 1;  ///< 3 with bounces, 1 without
  int bounces = 0;
  std::vector<Map> maps;  ///< ascending by primitive, at most one per primitive

  /// Returns the number of coefficients per texel.
  std::size_t rowLength() const { return static_cast<std::size_t>(order * order * channels); }
};

/// Transfer at moments of an animation, in world space with the nodes' pose at that moment. It is
/// interpolated between moments.
struct AnimatedTransfer {
  std::size_t animation = 0;           ///< index in the glTF file
  std::vector<double> times;           ///< [key], seconds, >= 0, strictly ascending, never empty
  std::vector<HarmonicTransfer> keys;  ///< [key], equal in order, channels and bounces
  /// [key], shadows of lamps within the scene at that moment, equal in order, shells and distances; empty:
  /// none
  std::vector<NearLampTransfer> nearLamps = {};
};

/// Diffuse transfer per vertex in Haar wavelets on the faces of a cube map (docs/notes/wavelets.md), sparse.
/// The solid angle of texels is included in the transfer, so that exit radiance = albedo x sum L_i T_i, where
/// L is the transformed radiance of the texels. There is one row per vertex and channel.
struct HaarTransfer {
  int faceSize = 0;  ///< texels, a power of two
  int channels = 1;  ///< 3 with bounces, 1 without
  int bounces = 0;
  std::vector<std::uint32_t> offsets;  ///< [vertex * channels + channel], followed by the end
  std::vector<std::uint32_t> indices;  ///< ascending within a row, below 6 faceSize^2
  std::vector<float> values;           ///< parallel to indices

  /// Returns the bytes per index in a file: two where these suffice for the texels of six faces.
  std::size_t storedIndexBytes() const { return 6 * faceSize * faceSize <= 0x10000 ? 2 : 4; }
};

/// Transfer of light that arrives at the other side of surfaces with diffuse transmission, within a body at
/// its inner side, in the forms of the transfer of fronts. With T the transfer of fronts and B this one, the
/// exit radiance of a front is albedo x sum L_i T_i + transmission x sum L_i B_i; for a back, T and B are
/// exchanged. Vertices of all other surfaces are 0.
struct ThroughTransfer {
  std::vector<float> ao;  ///< [vertex], accessibility; may be empty
  std::optional<HarmonicTransfer> sh;
  std::optional<HarmonicTransfer> ch;
  std::optional<HaarTransfer> haar;  ///< made from SH of the bands that bounces have
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

/// Vectors that a record of vector occluders may hold (Sherif 2013, 7.2): the meaning of xyz, then of w.
enum class OccluderVector : std::uint8_t {
  Position,       ///< mean of the visible part in world space; mean distance, m
  Occlusion,      ///< form-factor weighted sum of directions; form factor
  Caustic,        ///< form-factor weighted sum of directions after refraction; form factor
  Transmissive,   ///< mean colour of transmitted light; 0
  DiffuseNormal,  ///< sum of normals weighted by form factor and AO; sum of the weights
  DiffuseColor,   ///< mean diffuse colour; 0
  /// Sum of normals with an unoccluded reflection, weighted by form factor; sum of the weights.
  SpecularNormal,
  SpecularColor,  ///< mean specular colour; 0
};

constexpr std::array<std::string_view, 8> occluderVectorNames = {
    "position",      "occlusion",    "caustic",        "transmissive",
    "diffuseNormal", "diffuseColor", "specularNormal", "specularColor"};

/// Records of the occluders that each vertex sees, as one sparse row per vertex.
struct OccluderTransfer {
  std::vector<std::string> names;        ///< [occluder]
  std::vector<OccluderVector> stored;    ///< vectors of each record, ascending
  std::vector<std::uint32_t> offsets;    ///< [vertex], index of the first record, followed by the end
  std::vector<std::uint32_t> occluders;  ///< [record], ascending within a vertex
  std::vector<glm::vec4> vectors;        ///< [record][stored]

  std::size_t recordCount() const { return occluders.size(); }
};

/// Lights that are scaled and coloured together at run time.
struct LightGroup {
  std::string name;
  glm::vec3 color{
      1.0f};  ///< intensity in the file (W/sr, W/m2, W/(m2 sr)), in each channel that of its brightest light
};

/// Transfer of the scene's own lights at every vertex, with shadows and bounces. The exit radiance of
/// channel c is albedo[c] x sum_g color_g[c] T[vertex][c][g] for any colours of the groups.
struct LightGroupTransfer {
  std::vector<LightGroup> groups;
  int channels = 1;
  int bounces = 0;
  /// [vertex][channel][group], per unit of the group's colour, including 1/pi.
  std::vector<float> coefficients;
};

/// A grid of cubic cells in world space. Values belong to the centres of cells.
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

/// Transfer of points in the air: T_i = (1/(4 pi)) integral V Y_i dw, the mean over all directions, plus
/// light that visible surfaces reflect. The mean radiance at a point, which an isotropically scattering
/// medium takes in, is sum L_i T_i.
struct VolumeTransfer {
  VolumeGrid grid;
  int order = 0;
  int channels = 1;                 ///< 3 with bounces, 1 without
  int bounces = 0;                  ///< diffuse reflections at surfaces
  std::vector<float> coefficients;  ///< [z][y][x][channel][i]
  std::vector<float> direct;        ///< [z][y][x][i], without bounces; empty: same as `coefficients`
  std::vector<std::uint8_t> air;    ///< [z][y][x], 0: inside a closed object, where every ray hits a back

  /// Light that visible surfaces send, by direction: SH of their radiance, integral L Y_j dw, for objects
  /// that move through the volume. Order 0 and an empty array: not kept.
  int sentOrder = 0;
  std::vector<float> sent = {};  ///< [z][y][x][channel 3][j][i], with i the coefficient of the light

  /// Light of the scene's own lights after at least one reflection, by direction as in `sent`, per unit of
  /// a group's colour. The groups are those of Bake::lightGroups. Order 0 and an empty array: not kept.
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
  std::array<std::vector<double>, 3> coefficients;  ///< [channel][i], equal channels without bounces
  std::vector<double> direct;                       ///< [i]
};

/// Interpolates trilinearly between the centres of cells, constantly beyond them. Cells inside objects,
/// which would darken the neighbourhood, are ignored unless there are no others.
VolumeSample sampleVolume(const VolumeTransfer& volume, const glm::dvec3& position);

/// Returns the mean radiance over all directions, sum L_i T_i. `light` is [channel][i] with `lightColumns`
/// per channel, at least as many as the sample has.
glm::dvec3 meanRadiance(const VolumeSample& sample, std::span<const double> light, std::size_t lightColumns);

/// Methods of compressing transfer (docs/notes/compression.md).
enum class CompressionMethod : std::uint8_t {
  Half,   ///< IEEE half floats
  Band8,  ///< 8 bits, with an offset and a scale per band and channel (Staniszewski 2005, 3.2)
  Pca,    ///< one mean and principal components for all vertices
  Vq,     ///< vector quantisation: each vertex takes the mean of its cluster
  Cpca,   ///< clusters with principal components of their own (Sloan, Hall, Hart and Snyder 2003)
  Rgbe,   ///< 8 bits, with an exponent per vertex and band (Staniszewski 2005, 3.2)
};

/// How the weights of components are stored.
enum class WeightStorage : std::uint8_t { Float, Half, Byte };

/// Parameters of a compression. parseCompression() reads their names.
struct CompressionRequest {
  CompressionMethod method = CompressionMethod::Half;
  int clusters = 1;    ///< for Vq and Cpca, 1 to 65536; no more than vertices are made
  int components = 0;  ///< for Pca and Cpca, 1 to channels x order^2
  WeightStorage weights = WeightStorage::Half;
  std::uint64_t seed = 1;
  int iterations = 40;  ///< most re-assignments for each number of components
};

/// Compressed diffuse transfer. A vector holds all channels of a vertex, [channel][i], as in
/// HarmonicTransfer; its length is D = channels x order^2. Arrays that the method does not use are empty.
///
///   Half   T[v][c][i] = halves[v][c][i]
///   Band8  T[v][c][i] = ranges[c][l][0] + ranges[c][l][1] x bytes[v][c][i], l the band of i
///   Rgbe   T[v][c][i] = (bytes[v][c][i] - 128) / 128 x 2^(exponents[v][l] - 128), 0 for the exponent 0
///   others T[v]       = means[k] + sum_j weight[v][j] x basis[k][j], k = clusterOf[v]
///
/// By `weights`, weight[v][j] is weightFloats[v][j], weightHalves[v][j] or
/// weightRanges[k][j][0] + weightRanges[k][j][1] x weightBytes[v][j].
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
  int components = 0;                    ///< per cluster; 0 for Vq
  std::vector<float> means;              ///< [cluster][channel][i]
  std::vector<float> basis;              ///< [cluster][component][channel][i], orthonormal within a cluster
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
  /// Returns the weight of a component of a vertex in any storage.
  double weight(std::size_t vertex, std::size_t component) const;
  /// Returns the size of all arrays in bytes.
  std::size_t byteCount() const;
};

/// Compressed SH transfer of other parts than the vertices, as files store it. The parts' floats are the
/// decoded values.
struct CompressedParts {
  std::optional<CompressedTransfer> texels;        ///< texels of all charts, [map][row][column]
  std::optional<CompressedTransfer> keys;          ///< keys of an animation, [key][vertex]
  std::optional<CompressedTransfer> volume;        ///< VolumeTransfer::coefficients, [z][y][x]
  std::optional<CompressedTransfer> volumeDirect;  ///< VolumeTransfer::direct
  /// VolumeTransfer::sent, with a channel for each [channel][j].
  std::optional<CompressedTransfer> volumeSent;
};

/// Parses "half", "band8", "rgbe", "pca:K", "vq:N" or "cpca:N:K" (N clusters, K components). The last three
/// may be followed by the size of weights, 32, 16 or 8 bits: "cpca:64:8:float", ":half" (the default) or
/// ":byte". Throws UsageError.
CompressionRequest parseCompression(std::string_view text);

/// Returns the text that parseCompression() reads.
std::string compressionName(const CompressionRequest& request);

/// Compresses a scene's transfer. `vertexWeights`, [vertex] >= 0, weights each vertex's error, for instance
/// by its area; empty: all are equal. The result depends on the arguments alone, not on the number of
/// threads. Throws UsageError for more components than a vector has entries, and InputError for transfer
/// that is not finite or does not have order^2 coefficients per channel.
CompressedTransfer compress(const HarmonicTransfer& transfer, const CompressionRequest& request,
                            std::span<const double> vertexWeights = {});

/// Returns the transfer that a compressed one stands for.
HarmonicTransfer decompress(const CompressedTransfer& compressed);

}  // namespace prelight
