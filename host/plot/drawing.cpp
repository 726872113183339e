#include "plot/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/atomic_file.h"
#include "base/text.h"
#include "images/picture_codecs.h"
#include "prelight/error.h"

namespace prelight::plot {
namespace {

std::string base64Of(std::span<const std::uint8_t> bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t b = 0; b < 3; ++b) bits = bits << 8 | (b < count ? bytes[i + b] : 0u);
    for (std::size_t d = 0; d < 4; ++d) text += d <= count ? digits[bits >> (18 - 6 * d) & 63] : '=';
  }
  return text;
}

std::string cssOf(const Color& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

std::string svgOf(const Drawing& drawing) {
  const int width = drawing.pixels.width, height = drawing.pixels.height;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<image width=\"{0}\" height=\"{1}\" href=\"data:image/png;base64,{2}\"/>\n",
      width, height, base64Of(encodePng(drawing.pixels)));
  for (const Line& line : drawing.lines) {
    svg += "<polyline points=\"";
    for (const glm::dvec2& p : line.points) svg += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
    svg +=
        fmt::format("\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n", cssOf(line.color), line.width);
  }
  for (const Label& label : drawing.labels)
    svg += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" font-family=\"sans-serif\" font-size=\"12\" "
        "fill=\"{}\">{}</text>\n",
        label.place.x, label.place.y, cssOf(label.color), escapedText(label.text));
  return svg + "</svg>\n";
}

double distanceTo(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::length(p - a - t * along);
}

/// Draws lines into the pixels, with smooth edges.
Image withLines(const Drawing& drawing) {
  Image image = drawing.pixels;
  for (const Line& line : drawing.lines)
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const glm::dvec2 a = line.points[i - 1], b = line.points[i];
      const glm::dvec2 low = glm::min(a, b) - line.width - 1.0, high = glm::max(a, b) + line.width + 1.0;
      for (int y = std::max(0, static_cast<int>(low.y)); y < std::min<double>(image.height, high.y); ++y)
        for (int x = std::max(0, static_cast<int>(low.x)); x < std::min<double>(image.width, high.x); ++x) {
          const double away = distanceTo(a, b, {x + 0.5, y + 0.5});
          const double cover = std::clamp(0.5 * line.width + 0.5 - away, 0.0, 1.0);
          if (cover <= 0.0) continue;
          std::uint8_t* pixel = &image.rgba[4 * (static_cast<std::size_t>(y) * image.width + x)];
          for (int c = 0; c < 3; ++c)
            pixel[c] = static_cast<std::uint8_t>(
                std::lround(glm::mix(double(pixel[c]), double(line.color[c]), cover)));
        }
    }
  return image;
}

}  // namespace

void Drawing::set(int column, int row, const Color& color) {
  std::uint8_t* pixel =
      &pixels.rgba[4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(pixels.width) + column)];
  std::copy(color.begin(), color.end(), pixel);
}

Drawing blankDrawing(int width, int height) {
  return {{"plot", width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height, 255)}, {}, {}};
}

void addCircle(Drawing& drawing, const glm::dvec2& centre, double radius, const Color& color, double width) {
  constexpr int steps = 72;
  Line circle{{}, color, width};
  for (int i = 0; i <= steps; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / steps;
    circle.points.push_back(centre + radius * glm::dvec2(std::cos(turn), std::sin(turn)));
  }
  drawing.lines.push_back(std::move(circle));
}

void writeDrawing(const std::filesystem::path& path, const Drawing& drawing) {
  const std::filesystem::path extension = path.extension();
  if (extension != ".svg" && extension != ".png")
    throw UsageError(path.string(), "a plot is an .svg or a .png file");
  OutputFiles files;
  if (extension == ".svg") {
    const std::string svg = svgOf(drawing);
    files.add(path, std::as_bytes(std::span(svg)));
  } else {
    const std::vector<std::uint8_t> png = encodePng(withLines(drawing));
    files.add(path, std::as_bytes(std::span(png)));
  }
  files.commit();
}

}  // namespace prelight::plot
