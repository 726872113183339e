#include "benchmarks/canvas.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

#include "base/atomic_file.h"
#include "images/image_encode.h"

namespace prelight::benchmarks {

namespace {

/// "#2f6db5".
glm::vec3 colorOf(std::string_view hex) {
  glm::vec3 color(0.0f);
  assert(hex.size() == 7 && hex[0] == '#');
  for (int c = 0; c < 3; ++c) {
    unsigned value = 0;
    std::from_chars(hex.data() + 1 + 2 * c, hex.data() + 3 + 2 * c, value, 16);
    color[c] = static_cast<float>(value) / 255.0f;
  }
  return color;
}

/// Coverage of a pixel whose centre is this far (pixels) outside of a shape.
double within(double distance) { return std::clamp(0.5 - distance, 0.0, 1.0); }

constexpr double dashLength = 5.0, gapLength = 4.0;

/// Of UTF-8 with at most two bytes a character, which is what the font holds.
ImWchar nextCharacter(std::string_view text, std::size_t& place) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(place++);
  if (first < 0x80) return static_cast<ImWchar>(first);
  const bool two = (first & 0xe0) == 0xc0 && place < text.size();
  const unsigned character = two ? (first & 0x1f) << 6 | (byte(place) & 0x3f) : '?';
  while (place < text.size() && (byte(place) & 0xc0) == 0x80) ++place;
  return static_cast<ImWchar>(character);
}

/// Coverage of a line of text.
struct Mask {
  int width = 0;
  int height = 0;
  double ascent = 0.0;
  std::vector<float> coverage;  ///< [row][column]
};

}  // namespace

/// The bitmap font that Dear ImGui carries, in whole multiples of its size.
class Canvas::Font {
 public:
  Mask write(std::string_view text, double pixels, bool bold) {
    const ImFont& font = ofSize(std::clamp(static_cast<int>(std::lround(pixels / nativeSize)), 1, most));
    std::vector<const ImFontGlyph*> glyphs;
    double width = 0.0;
    for (std::size_t i = 0; i < text.size();) {
      glyphs.push_back(font.FindGlyph(nextCharacter(text, i)));
      width += glyphs.back()->AdvanceX;
    }
    Mask mask{static_cast<int>(std::ceil(width)) + 2,
              static_cast<int>(std::ceil(font.FontSize)) + 1,
              font.Ascent,
              {}};
    mask.coverage.resize(static_cast<std::size_t>(mask.width) * mask.height, 0.0f);
    double x = 0.0;
    for (const ImFontGlyph* glyph : glyphs) {
      stamp(*glyph, static_cast<int>(x), mask);
      if (bold) stamp(*glyph, static_cast<int>(x) + 1, mask);
      x += glyph->AdvanceX;
    }
    return mask;
  }

 private:
  static constexpr double nativeSize = 13.0;
  static constexpr int most = 4;

  const ImFont& ofSize(int multiple) {
    if (atlas_.Fonts.empty()) {
      for (int m = 1; m <= most; ++m) {
        ImFontConfig config;
        config.SizePixels = static_cast<float>(nativeSize * m);
        config.OversampleH = config.OversampleV = 1;
        config.PixelSnapH = true;
        atlas_.AddFontDefault(&config);
      }
      atlas_.GetTexDataAsAlpha8(&texels_, &columns_, &rows_);
    }
    return *atlas_.Fonts[multiple - 1];
  }

  void stamp(const ImFontGlyph& glyph, int left, Mask& mask) const {
    const int u = static_cast<int>(std::lround(glyph.U0 * static_cast<float>(columns_)));
    const int v = static_cast<int>(std::lround(glyph.V0 * static_cast<float>(rows_)));
    const int width = static_cast<int>(std::lround(glyph.X1 - glyph.X0));
    const int height = static_cast<int>(std::lround(glyph.Y1 - glyph.Y0));
    const int x0 = left + static_cast<int>(std::lround(glyph.X0)),
              y0 = static_cast<int>(std::lround(glyph.Y0));
    for (int y = std::max(0, -y0); y < std::min(height, mask.height - y0); ++y)
      for (int x = std::max(0, -x0); x < std::min(width, mask.width - x0); ++x) {
        float& to = mask.coverage[static_cast<std::size_t>(y0 + y) * mask.width + x0 + x];
        to = std::max(to, static_cast<float>(texels_[(v + y) * columns_ + u + x]) / 255.0f);
      }
  }

  ImFontAtlas atlas_;
  unsigned char* texels_ = nullptr;
  int columns_ = 0;
  int rows_ = 0;
};

Canvas::Canvas(double width, double height, double scale)
    : scale_(scale),
      width_(static_cast<int>(std::ceil(width * scale))),
      height_(static_cast<int>(std::ceil(height * scale))),
      pixels_(static_cast<std::size_t>(width_) * height_, glm::vec3(1.0f)),
      font_(std::make_unique<Font>()) {}

Canvas::Canvas(Canvas&& other) noexcept = default;
Canvas::~Canvas() = default;

template <typename Coverage>
void Canvas::paint(glm::dvec2 low, glm::dvec2 high, std::string_view color, const Coverage& coverage) {
  const glm::vec3 paint = colorOf(color);
  const int left = std::max(0, static_cast<int>(std::floor(low.x)) - 1);
  const int right = std::min(width_, static_cast<int>(std::ceil(high.x)) + 1);
  const int top = std::max(0, static_cast<int>(std::floor(low.y)) - 1);
  const int bottom = std::min(height_, static_cast<int>(std::ceil(high.y)) + 1);
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      glm::vec3& pixel = pixels_[static_cast<std::size_t>(y) * width_ + x];
      pixel = glm::mix(pixel, paint, static_cast<float>(coverage(glm::dvec2(x + 0.5, y + 0.5))));
    }
}

void Canvas::rectangle(Point corner, double width, double height, std::string_view color) {
  const glm::dvec2 low = scale_ * glm::dvec2(corner.x, corner.y),
                   high = low + scale_ * glm::dvec2(width, height);
  paint(low, high, color, [&](const glm::dvec2& p) {
    const glm::dvec2 covered = glm::clamp(glm::min(p + 0.5, high) - glm::max(p - 0.5, low), 0.0, 1.0);
    return covered.x * covered.y;
  });
}

void Canvas::circle(Point centre, double radius, std::string_view color) {
  const glm::dvec2 middle = scale_ * glm::dvec2(centre.x, centre.y);
  const double r = scale_ * radius;
  paint(middle - r, middle + r, color,
        [&](const glm::dvec2& p) { return within(glm::distance(p, middle) - r); });
}

void Canvas::segment(Point from, Point to, const Stroke& stroke) {
  const glm::dvec2 a = scale_ * glm::dvec2(from.x, from.y), b = scale_ * glm::dvec2(to.x, to.y);
  const double half = 0.5 * scale_ * stroke.width, length2 = glm::dot(b - a, b - a);
  paint(glm::min(a, b) - half, glm::max(a, b) + half, stroke.color, [&](const glm::dvec2& p) {
    const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, b - a) / length2, 0.0, 1.0) : 0.0;
    return within(glm::distance(p, a + t * (b - a)) - half);
  });
}

void Canvas::line(const std::vector<Point>& points, const Stroke& stroke) {
  double walked = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point a = points[i - 1], b = points[i];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!stroke.dashed || length == 0.0) {
      segment(a, b, stroke);
      continue;
    }
    const auto at = [&](double s) {
      return Point{a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length};
    };
    constexpr double period = dashLength + gapLength;
    for (double dash = -std::fmod(walked, period); dash < length; dash += period) {
      const double begin = std::max(dash, 0.0), end = std::min(dash + dashLength, length);
      if (end > begin) segment(at(begin), at(end), stroke);
    }
    walked += length;
  }
}

void Canvas::text(Point at, std::string_view text, const TextStyle& style) {
  const Mask mask = font_->write(text, scale_ * style.size, style.bold);
  const double shift = style.anchor == Anchor::Start ? 0.0 : style.anchor == Anchor::Middle ? 0.5 : 1.0;
  const auto along = static_cast<int>(std::lround(-shift * mask.width));
  const auto down = static_cast<int>(std::lround(-mask.ascent));
  const auto x0 = static_cast<int>(std::lround(scale_ * at.x)),
             y0 = static_cast<int>(std::lround(scale_ * at.y));
  const glm::vec3 paint = colorOf(style.color);
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column) {
      const int s = along + column, t = down + row;
      const int x = style.upright ? x0 + t : x0 + s, y = style.upright ? y0 - s : y0 + t;
      if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
      glm::vec3& pixel = pixels_[static_cast<std::size_t>(y) * width_ + x];
      pixel = glm::mix(pixel, paint, mask.coverage[static_cast<std::size_t>(row) * mask.width + column]);
    }
}

void Canvas::picture(Point corner, std::span<const glm::vec3> encoded, int width) {
  const auto x0 = static_cast<int>(std::lround(scale_ * corner.x)),
             y0 = static_cast<int>(std::lround(scale_ * corner.y));
  for (std::size_t i = 0; i < encoded.size(); ++i) {
    const int x = x0 + static_cast<int>(i) % width, y = y0 + static_cast<int>(i) / width;
    if (x >= 0 && y >= 0 && x < width_ && y < height_)
      pixels_[static_cast<std::size_t>(y) * width_ + x] = encoded[i];
  }
}

void Canvas::write(const std::filesystem::path& path) const {
  Image image{path.filename().string(), width_, height_, {}};
  for (const glm::vec3& pixel : pixels_) {
    for (int c = 0; c < 3; ++c)
      image.rgba.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(pixel[c], 0.0f, 1.0f) * 255.0f)));
    image.rgba.push_back(255);
  }
  const std::vector<std::uint8_t> bytes = encodePng(image);
  const std::array<std::span<const std::byte>, 1> pieces = {std::as_bytes(std::span(bytes))};
  writeFileAtomically(path, pieces);
}

}  // namespace prelight::benchmarks
