#pragma once

#include <string>

#include "benchmarks/drawing.h"

namespace prelight::benchmarks {

/// A drawing as a file that browsers show.
class Svg final : public Drawing {
 public:
  Svg(double width, double height);

  void rectangle(Point corner, double width, double height, std::string_view color) override;
  void circle(Point centre, double radius, std::string_view color) override;
  void line(const std::vector<Point>& points, const Stroke& stroke) override;
  void text(Point at, std::string_view text, const TextStyle& style = {}) override;

  /// The complete file.
  std::string str() const;

 private:
  std::string body_;
};

}  // namespace prelight::benchmarks
