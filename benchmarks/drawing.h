#pragma once

#include <string_view>
#include <vector>

namespace prelight::benchmarks {

struct Point {
  double x = 0.0;
  double y = 0.0;
};

enum class Anchor { Start, Middle, End };

struct TextStyle {
  double size = 12.0;
  std::string_view color = "#3c4043";
  Anchor anchor = Anchor::Start;
  bool bold = false;
  bool upright = false;  ///< turned to read from bottom to top
};

struct Stroke {
  std::string_view color;
  double width = 1.0;
  bool dashed = false;
};

/// Pixels that a text takes at most in the usual fonts, which this program cannot ask.
double textWidth(std::string_view text, const TextStyle& style = {});

/// The few shapes that charts are made of, in pixels from the upper left corner.
class Drawing {
 public:
  virtual ~Drawing() = default;

  virtual void rectangle(Point corner, double width, double height, std::string_view color) = 0;
  virtual void circle(Point centre, double radius, std::string_view color) = 0;
  virtual void line(const std::vector<Point>& points, const Stroke& stroke) = 0;

  /// `at` is on the base line.
  virtual void text(Point at, std::string_view text, const TextStyle& style = {}) = 0;
};

}  // namespace prelight::benchmarks
