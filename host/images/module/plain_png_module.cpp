#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <vector>

#include "images/plain_png.h"

namespace prelight {

namespace {

/// Bytes that libpng has yet to read.
struct PngSource {
  std::span<const std::uint8_t> left;
};

void readBytes(png_structp png, png_bytep out, std::size_t count) {
  auto& source = *static_cast<PngSource*>(png_get_io_ptr(png));
  if (count > source.left.size()) png_error(png, "cut short");
  std::memcpy(out, source.left.data(), count);
  source.left = source.left.subspan(count);
}

[[noreturn]] void leave(png_structp png, png_const_charp) { png_longjmp(png, 1); }
void stayQuiet(png_structp, png_const_charp) {}

/// Libpng's state, which is destroyed even after libpng has jumped out with longjmp.
class PngReader {
 public:
  explicit PngReader(std::span<const std::uint8_t> bytes) : source_{bytes} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, leave, stayQuiet);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ != nullptr) png_set_read_fn(png_, &source_, readBytes);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// Reads the header. Returns false for broken or unsupported pictures. No objects with destructors may
  /// exist where libpng may jump from.
  bool readHeader() {
    if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_info(png_, info_);
    return png_get_bit_depth(png_, info_) == 8 && png_get_interlace_type(png_, info_) == PNG_INTERLACE_NONE &&
           png_get_valid(png_, info_, PNG_INFO_tRNS) == 0;
  }

  /// Reads the rows as RGBA. Returns false for broken pictures. `rows` point to memory for one row each.
  bool readRows(std::uint8_t* const* rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_palette_to_rgb(png_);
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 255, PNG_FILLER_AFTER);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != 4 * std::size_t{width()}) return false;
    png_read_image(png_, const_cast<std::uint8_t**>(rows));
    png_read_end(png_, nullptr);
    return true;
  }

  std::uint32_t width() const { return png_get_image_width(png_, info_); }
  std::uint32_t height() const { return png_get_image_height(png_, info_); }

 private:
  PngSource source_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

}  // namespace prelight

extern "C" bool prelightDecodePlainPng(std::span<const std::uint8_t> bytes, prelight::Image& image) {
  prelight::PngReader reader(bytes);
  if (!reader.readHeader()) return false;
  const std::size_t width = reader.width(), height = reader.height();
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.rgba.resize(4 * width * height);
  std::vector<std::uint8_t*> rows(height);
  for (std::size_t y = 0; y < height; ++y) rows[y] = &image.rgba[4 * width * y];
  return reader.readRows(rows.data());
}
