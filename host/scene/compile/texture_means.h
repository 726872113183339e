#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/scene.h"

namespace prelight {

/// Corners of a triangle in an image's coordinates: [0,1] from left to right and downwards; outside, the
/// texture wraps.
using ImageCorners = std::array<glm::dvec2, 3>;

/// Means of a colour texture over triangles, as look-ups on a device see it: linear 16-bit colours,
/// interpolated between texels unless the texture says otherwise, without mipmaps.
class TextureMeans {
 public:
  /// Greatest number of texels that the outline of a triangle may cross for its mean to be exact.
  static constexpr double exactOutline = 131072.0;

  /// `image` must outlive this object and is stored in sRGB.
  TextureMeans(const Image& image, const TextureRef& use);

  /// Returns the mean colour of a triangle: an integral along its outline (Green's theorem), of which every
  /// part within four neighbouring texels is a polynomial. A smaller image is used where the outline crosses
  /// more than `outline` texels, and samples for a triangle without area in the image.
  glm::dvec3 mean(const ImageCorners& corners, double outline = exactOutline);

  /// Returns an upper bound of the luminance of all points of a triangle; 0 where the triangle is black.
  double mostLuminance(const ImageCorners& corners) const;

  /// Returns the colour at a point.
  glm::dvec3 at(const glm::dvec2& point) const;

 private:
  /// The image at one size, with sums over its rows.
  struct Level {
    int width = 0, height = 0;
    std::vector<glm::vec3> texels;      ///< texels of smaller sizes; the image's own are decoded when needed
    std::vector<glm::dvec3> blockSums;  ///< [row][block of texels] sum of the texels before it in the row
    std::vector<glm::dvec3> rowSums;    ///< [row]
    std::size_t blocksARow = 0;
  };
  /// Greatest luminances of squares of texels.
  struct Bounds {
    int side = 0, columns = 0, rows = 0;  ///< texels per square, squares
    std::vector<float> most;
  };
  glm::dvec3 texel(const Level& level, int column, int row) const;
  glm::dvec3 wrappedTexel(const Level& level, double column, double row) const;
  glm::dvec3 sumBefore(const Level& level, double column, int row) const;
  glm::dvec3 rowIntegral(const Level& level, double first, double column, double x, int row) const;
  glm::dvec3 alongEdge(const Level& level, const glm::dvec2& a, const glm::dvec2& b, double first) const;
  glm::dvec3 meanOfSamples(const ImageCorners& corners) const;
  glm::dvec3 lookUp(const Level& level, const glm::dvec2& place) const;
  glm::dvec2 placeIn(const Level& level, const glm::dvec2& point) const;
  ImageCorners placesIn(const Level& level, const ImageCorners& corners) const;
  double mostWithin(const std::array<int, 2>& columns, const std::array<int, 2>& rows) const;
  void sumRows(Level& level) const;
  void addSmaller();
  void boundLuminance();

  const Image& image_;
  TextureRef use_;
  double middle_;               ///< offset of a texel's centre where interpolation counts, otherwise 0
  std::vector<Level> levels_;   ///< the image's own size, then quarters of it as needed
  std::vector<Bounds> bounds_;  ///< finest first
};

}  // namespace prelight
