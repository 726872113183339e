#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "basis/cube_map.h"

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

/// Diffuse SH transfer at the texels of charts (scene/gltf/charts.h): HarmonicTransfer's, with the texel's own
/// normal where the surface has a normal map.
struct ChartTransfer {
  struct Map {
    std::size_t primitive = 0;  ///< into CompiledScene::primitives
    int width = 0;
    int height = 0;
    std::vector<glm::vec2> coords;    ///< [vertex of the primitive], in [0,1]^2; row 0 is at v = 0
    std::vector<float> coefficients;  ///< [row][column][channel][i]; off the surface, those of what is next
  };
  int order = 0;
  int channels = 1;  ///< 3 with bounces, 1 without
  int bounces = 0;
  std::vector<Map> maps;  ///< ascending by primitive; at most one a primitive

  /// Coefficients a texel.
  std::size_t rowLength() const { return static_cast<std::size_t>(order * order * channels); }
};

/// Transfer at moments of an animation, in world space as the nodes stand then. Between them it is
/// interpolated (transfer/animated_transfer.h).
struct AnimatedTransfer {
  std::size_t animation = 0;           ///< in the glTF file
  std::vector<double> times;           ///< [key], seconds, >= 0, strictly ascending, never empty
  std::vector<HarmonicTransfer> keys;  ///< [key], of one order, number of channels and of bounces
};

/// Diffuse transfer of every vertex in Haar wavelets on the faces of a cube map (basis/haar.h), sparse. The
/// solid angle of texels is in the transfer, so that exit radiance = albedo x sum L_i T_i with L the
/// transformed radiance of the texels. A row belongs to a vertex and a channel.
struct HaarTransfer {
  int faceSize = 0;  ///< texels, a power of two
  int channels = 1;  ///< 3 with bounces, 1 without
  int bounces = 0;
  std::vector<std::uint32_t> offsets;  ///< [vertex * channels + channel], then the end
  std::vector<std::uint32_t> indices;  ///< ascending within a row, below 6 faceSize^2
  std::vector<float> values;           ///< parallel to indices

  /// Of an index in a file: 16 bits wherever they tell the texels of six faces apart.
  std::size_t storedIndexBytes() const { return cubeTexelCount(faceSize) <= 0x10000 ? 2 : 4; }
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

}  // namespace prelight
