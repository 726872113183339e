#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace prelight {

/// A texel's place on the surface. Face numbers below the triangle count are fronts of triangles; the back of
/// a triangle with a double-sided material is triangle count + triangle.
struct LightMapTexel {
  std::uint32_t texel = 0;  ///< y * width + x
  std::uint32_t face = 0;
  float b1 = 0.0f;  ///< barycentric weight of vertex 1
  float b2 = 0.0f;  ///< barycentric weight of vertex 2
  /// Whether the place represents all of the texel's square; false: other surfaces divide the square.
  bool whole = true;
};

/// Where the faces of a scene lie in a light map. The centre of texel (x, y) is (x + 0.5, y + 0.5). Row 0 is
/// the top row, at v = 0.
struct LightMapLayout {
  static constexpr std::uint32_t noChart = 0xffffffffu;

  int width = 0;
  int height = 0;
  std::vector<glm::vec2> corners;      ///< [face][3], in texels from the upper left corner
  std::vector<std::uint32_t> chartOf;  ///< [face], or noChart for missing backs, lights and glass
  std::vector<LightMapTexel> texels;   ///< texels that bilinear look-ups on a face can read, row by row
  std::uint32_t chartCount = 0;
  static constexpr float noWall = 2.0f;

  /// Nearest wall, which stands on or crosses the surface, between a texel's place and the places of the
  /// texels to its right and below it: its distance as a fraction of the way, 0 to 1, or noWall.
  struct Wall {
    float right = noWall;
    float below = noWall;
    bool inside = false;  ///< whether the texel's own place lies inside an object

    bool operator==(const Wall&) const = default;
  };
  /// [y][x]; empty: no walls. Look-ups do not mix texels across a wall (docs/notes/lightmaps.md).
  std::vector<Wall> walls;

  std::size_t texelCount() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// Light arriving at vertices or at the texels of a light map, stored in an encoding
/// (docs/notes/encodings.md).
struct EncodedLight {
  std::string encoding;       ///< name of the encoding
  std::vector<float> values;  ///< [vertex][value], or [y][x][value] for texels, which are 0 off the surface
};

/// Light on a scene's surfaces per texel. Interpolation is bilinear except across walls; texels without a
/// place on the surface are 0.
struct LightMap {
  LightMapLayout layout;
  /// 1: irradiance, W/m2, on the side of the face's geometric normal; 1 + n n: also incident radiance in SH
  /// of order n, 2 for bump maps.
  int coefficients = 1;
  std::vector<float> values;          ///< [y][x][channel 3][coefficients]
  std::vector<EncodedLight> encoded;  ///< encoded light at the texels, one entry per encoding
};

}  // namespace prelight
