#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace prelight {

/// A texel's place on the surface. A face is a triangle's front (its index) or, where its material is
/// double-sided, its back (triangle count + index).
struct LightMapTexel {
  std::uint32_t texel = 0;  ///< y * width + x
  std::uint32_t face = 0;
  float b1 = 0.0f;  ///< barycentric weight of vertex 1
  float b2 = 0.0f;  ///< of vertex 2
  bool whole =
      true;  ///< the place stands for all of the texel's square; false: other surfaces part the square
};

/// Where the faces of a scene lie in a light map. Texel (x, y) has its centre at (x + 0.5, y + 0.5); row 0 is
/// the upper one, at v = 0.
struct LightMapLayout {
  static constexpr std::uint32_t noChart = 0xffffffffu;

  int width = 0;
  int height = 0;
  std::vector<glm::vec2> corners;      ///< [face][3], in texels from the upper left
  std::vector<std::uint32_t> chartOf;  ///< [face], or noChart: a back that is not there, a light, glass
  std::vector<LightMapTexel> texels;   ///< those that a bilinear look-up on a face can meet, row by row
  std::uint32_t chartCount = 0;
  static constexpr float noWall = 2.0f;

  /// What stands on or crosses the surface between a texel's place and those of the texels right of and below
  /// it, as a share of the way there, 0 to 1, or noWall.
  struct Wall {
    float right = noWall;
    float below = noWall;
    bool inside = false;  ///< the texel's own place lies inside an object

    bool operator==(const Wall&) const = default;
  };
  /// [y][x]. Look-ups mix no texels beyond a wall (docs/lightmaps.md). Empty: there are no walls.
  std::vector<Wall> walls;

  std::size_t texelCount() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// Light that arrives at vertices, or at the texels of a light map, as an encoding stores it
/// (docs/encodings.md).
struct EncodedLight {
  std::string encoding;       ///< its name
  std::vector<float> values;  ///< [vertex][value], or [y][x][value] of texels, 0 where there is no surface
};

/// Light on a scene's surfaces, texel by texel. Between texels it is bilinear, where no wall parts them;
/// texels without a place on the surface are 0.
struct LightMap {
  LightMapLayout layout;
  int coefficients = 1;       ///< 1: irradiance, W/m2, on the side of the face's geometric normal. 1 + n n:
                              ///< incident radiance in SH of order n as well, 2 for bump maps
  std::vector<float> values;  ///< [y][x][channel 3][coefficients]
  std::vector<EncodedLight> encoded;  ///< of texels
};

}  // namespace prelight
