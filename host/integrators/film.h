#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "images/picture_parts.h"
#include "prelight/picture.h"

namespace prelight::reference {

/// A picture that accumulates passes. Each pass adds one mean per pixel, independent of other passes, so that
/// their scatter gives the variance. Sums are doubles, which are precise enough for 10^5 passes.
struct Film {
  int width = 0;
  int height = 0;
  std::uint64_t passes = 0;         ///< number of complete passes
  std::uint64_t blockPixels = 0;    ///< number of pixels, row by row, that already include the next pass
  std::vector<glm::dvec3> sums;     ///< [pixel], sum over passes
  std::vector<double> means;        ///< [pixel], mean luminance
  std::vector<double> squares;      ///< [pixel], sum of squared deviations from the mean (Welford 1962)
  std::vector<double> blurs;        ///< [pixel], sum over passes of the approximate luminance added by blur
  std::vector<double> blurSquares;  ///< [pixel], sum of squares of the latter
  /// [PicturePart][pixel], sum over passes for the traced parts; may be empty.
  std::vector<glm::dvec3> parts;

  Film() = default;
  Film(int pictureWidth, int pictureHeight, bool withParts = false);

  std::size_t pixelCount() const { return sums.size(); }

  /// Adds the current pass' means for pixels from blockPixels on. The last pixel completes the pass. w is the
  /// approximate luminance that blur has added. `partMeans` is [PicturePart][pixel], if the film has parts.
  void add(std::span<const glm::vec4> means, std::span<const glm::vec4> partMeans = {});

  /// Returns the mean radiance. Requires a complete pass; pixels of an incomplete pass are included.
  Picture picture() const;

  /// Returns the parts that sum up to the picture, or nothing if the film has no parts.
  std::vector<PartPicture> partPictures() const;

  /// Returns the estimated variance of each pixel's mean luminance, [pixel]; empty before the second pass.
  std::vector<float> variance() const;

  /// Returns the root mean square over pixels of the error of luminance (its standard error and the luminance
  /// added by blur), relative to the picture's mean luminance. Infinite before the second pass, 0 for a black
  /// picture.
  double relativeError() const;

  /// Returns the part of the relative error that is due to blur, which the scatter of passes does not show.
  double relativeBlur() const;

 private:
  double meanLuminance() const;
  std::uint64_t count(std::size_t pixel) const { return passes + (pixel < blockPixels ? 1 : 0); }
};

}  // namespace prelight::reference
