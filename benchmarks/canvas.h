#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "benchmarks/drawing.h"

namespace prelight::benchmarks {

/// A drawing of pixels, smooth at its edges, with a font of its own: the same on every machine.
class Canvas final : public Drawing {
 public:
  /// White. A unit of the drawing is `scale` pixels; text looks best where that is a whole number.
  Canvas(double width, double height, double scale = 1.0);
  Canvas(Canvas&& other) noexcept;
  ~Canvas() override;

  void rectangle(Point corner, double width, double height, std::string_view color) override;
  void circle(Point centre, double radius, std::string_view color) override;
  void line(const std::vector<Point>& points, const Stroke& stroke) override;
  void text(Point at, std::string_view text, const TextStyle& style = {}) override;

  /// Copies sRGB-encoded pixels, rows top to bottom, one to one.
  void picture(Point corner, std::span<const glm::vec3> encoded, int width);

  int width() const { return width_; }
  int height() const { return height_; }
  std::span<const glm::vec3> pixels() const { return pixels_; }

  /// Writes a .png of 8 bits a channel beside `path` and renames it.
  void write(const std::filesystem::path& path) const;

 private:
  class Font;

  /// Mixes a colour in by `coverage` of each pixel of a box (pixels), a function of its centre.
  template <typename Coverage>
  void paint(glm::dvec2 low, glm::dvec2 high, std::string_view color, const Coverage& coverage);
  void segment(Point from, Point to, const Stroke& stroke);

  double scale_;
  int width_;
  int height_;
  std::vector<glm::vec3> pixels_;
  std::unique_ptr<Font> font_;
};

}  // namespace prelight::benchmarks
