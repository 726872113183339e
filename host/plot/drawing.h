#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "prelight/picture.h"

namespace prelight::plot {

/// An sRGB colour with 8 bits per channel.
using Color = std::array<std::uint8_t, 3>;

constexpr Color positiveColor{66, 120, 196}, negativeColor{226, 118, 52};  ///< of functions
constexpr Color belowZeroColor{150, 60, 190};                              ///< of maps

constexpr int captionHeight = 20;  ///< pixels below a picture for its caption

/// A line through points, in pixels from the upper left corner.
struct Line {
  std::vector<glm::dvec2> points;
  Color color{};
  double width = 1.5;
};

/// A text. Its baseline is centred about a place.
struct Label {
  glm::dvec2 place;
  std::string text;
  Color color{60, 60, 60};
};

/// A picture with lines and labels over it.
struct Drawing {
  Image pixels;
  std::vector<Line> lines;
  std::vector<Label> labels;

  void set(int column, int row, const Color& color);
};

/// Returns an empty white drawing.
Drawing blankDrawing(int width, int height);

/// Adds a circle as a line.
void addCircle(Drawing& drawing, const glm::dvec2& centre, double radius, const Color& color, double width);

/// Writes an .svg file, or a .png file without the labels, by the extension. The file appears whole or not at
/// all. Throws UsageError for another extension and Error when the file cannot be written.
void writeDrawing(const std::filesystem::path& path, const Drawing& drawing);

}  // namespace prelight::plot
