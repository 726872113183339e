#include "benchmarks/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace prelight::benchmarks {

namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else
      result += c;
  }
  return result;
}

}  // namespace

double textWidth(std::string_view text, const TextStyle& style) {
  // UTF-8 continues a character by bytes 10xxxxxx.
  const auto characters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; });
  return static_cast<double>(characters) * style.size * (style.bold ? 0.66 : 0.58);
}

Svg::Svg(double width, double height)
    : body_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
                        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"Helvetica, Arial, sans-serif\">\n",
                        width, height)) {
  rectangle({0, 0}, width, height, "#ffffff");
}

void Svg::rectangle(Point corner, double width, double height, std::string_view color) {
  body_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
                       corner.x, corner.y, width, height, color);
}

void Svg::circle(Point centre, double radius, std::string_view color) {
  body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"/>\n", centre.x, centre.y,
                       radius, color);
}

void Svg::line(const std::vector<Point>& points, const Stroke& stroke) {
  body_ += "<polyline points=\"";
  for (const Point& p : points) body_ += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
  body_ += fmt::format("\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", stroke.color, stroke.width,
                       stroke.dashed ? " stroke-dasharray=\"5 4\"" : "");
}

void Svg::text(Point at, std::string_view text, const TextStyle& style) {
  constexpr std::array<const char*, 3> anchors = {"start", "middle", "end"};
  body_ += fmt::format(
      "<text x=\"{0:.1f}\" y=\"{1:.1f}\" font-size=\"{2}\" fill=\"{3}\" "
      "text-anchor=\"{4}\"{5}{6}>{7}</text>\n",
      at.x, at.y, style.size, style.color, anchors[static_cast<std::size_t>(style.anchor)],
      style.bold ? " font-weight=\"bold\"" : "",
      style.upright ? fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", at.x, at.y) : "",
      escaped(text));
}

std::string Svg::str() const { return body_ + "</svg>\n"; }

}  // namespace prelight::benchmarks
