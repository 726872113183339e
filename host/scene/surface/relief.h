#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/scene.h"

namespace prelight {

/// Heights reconstructed from a normal texture's slopes, and the horizon that they form around every place.
/// Texels count as square on the surface; lengths are in cells.
class Relief {
 public:
  static constexpr int azimuths = 16;    ///< from the tangent towards the bitangent, over the full circle
  static constexpr int mostCells = 256;  ///< per side; slopes of larger textures are averaged

  /// `scale`: factor of the texture's x and y (glTF's normalTexture.scale).
  Relief(const Image& normals, const TextureRef& use, double scale);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Returns the heights [row][column], of mean 0.
  const std::vector<double>& heights() const { return heights_; }

  /// Returns [azimuth] the sine of the elevation below which the relief hides the sky, at texture
  /// coordinates.
  const float* horizonAt(const glm::dvec2& uv) const;

 private:
  double heightAt(double column, double row) const;
  void integrate(const std::vector<glm::dvec2>& slopes);
  void findHorizons();
  /// Returns the index for a place that may lie outside: in the next repetition, or at the edge.
  int columnOf(int column) const;
  int rowOf(int row) const;

  int width_ = 0, height_ = 0;
  bool repeatsAcross_ = true, repeatsDown_ = true;
  std::vector<double> heights_;
  std::vector<float> horizons_;  ///< [row][column][azimuth]
};

}  // namespace prelight
