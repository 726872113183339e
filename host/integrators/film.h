#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "images/picture_parts.h"
#include "prelight/picture.h"

namespace prelight::reference {

/// A picture as it grows pass by pass. Every pass adds one mean a pixel that is independent of the other
/// passes, so that their scatter tells the variance. Sums are doubles: what a pass adds is not lost after
/// 10^5 of them.
struct Film {
  int width = 0;
  int height = 0;
  std::uint64_t passes = 0;         ///< complete ones
  std::uint64_t blockPixels = 0;    ///< pixels, row by row, that already hold the pass after those
  std::vector<glm::dvec3> sums;     ///< [pixel] sum over passes
  std::vector<double> means;        ///< [pixel] mean luminance
  std::vector<double> squares;      ///< [pixel] sum of squared deviations from it (Welford 1962)
  std::vector<double> blurs;        ///< [pixel] sum over passes of luminance that blur has added, about
  std::vector<double> blurSquares;  ///< [pixel] sum of their squares
  std::vector<glm::dvec3> parts;  ///< [PicturePart][pixel] sum over passes of those that are traced; or empty

  Film() = default;
  Film(int pictureWidth, int pictureHeight, bool withParts = false);

  std::size_t pixelCount() const { return sums.size(); }

  /// Adds the current pass' mean of the pixels from blockPixels on. The pass is complete with the last pixel.
  /// w: luminance that blur has added to it, about. `partMeans`: [PicturePart][pixel], where the film has
  /// parts.
  void add(std::span<const glm::vec4> means, std::span<const glm::vec4> partMeans = {});

  /// Mean radiance. Needs a complete pass; takes pixels of an incomplete one with it.
  Picture picture() const;

  /// What the picture is a sum of; nothing where the film has no parts.
  std::vector<PartPicture> partPictures() const;

  /// [pixel] estimated variance of the pixel's mean luminance; empty before the second pass.
  std::vector<float> variance() const;

  /// Root mean square over pixels of the standard error of luminance and of what blur adds to it, over the
  /// picture's mean luminance. Infinite before the second pass, 0 for a black picture.
  double relativeError() const;

  /// The part of it that is blur, which does not show in the scatter of passes.
  double relativeBlur() const;

 private:
  double meanLuminance() const;
  std::uint64_t count(std::size_t pixel) const { return passes + (pixel < blockPixels ? 1 : 0); }
};

}  // namespace prelight::reference
