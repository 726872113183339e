#include "images/pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "base/files.h"
#include "images/exr_header.h"
#include "images/picture_codecs.h"
#include "images/picture_decoding.h"
#include "prelight/error.h"

namespace prelight {

namespace {

/// Throws InputError for a file that is shorter than the picture that its header claims.
void checkHdrHeader(const std::filesystem::path& path) {
  constexpr std::uint64_t longestHeader = 1 << 16;
  const std::string where = path.string();
  const std::uint64_t bytes = std::filesystem::file_size(path);
  const std::optional<PictureExtent> extent = pictureExtent(readFileBytes(path, where, longestHeader));
  if (!extent)
    throw InputError(where, "cannot be read as a picture: its header is broken or cut short",
                     "the file is damaged, or write it again");
  if (extent->texels() > mostPictureTexels || bytes < extent->leastBytes)
    throw InputError(where,
                     fmt::format("cannot be read as a picture: {} x {} texels in {} bytes, expected at most "
                                 "{} texels and {} bytes at least",
                                 extent->width, extent->height, bytes, mostPictureTexels, extent->leastBytes),
                     "the file is damaged, or scale the picture down");
}

}  // namespace

Pixels readPixels(const std::filesystem::path& path) {
  const PictureFormat format = requirePictureFile(
      path, {PictureFormat::Exr, PictureFormat::Hdr, PictureFormat::Png, PictureFormat::Jpeg});
  return decodePixels(readFileBytes(path, path.string()), format, path.string());
}

PictureFormat requirePictureFile(const std::filesystem::path& path,
                                 std::initializer_list<PictureFormat> formats) {
  refuseSpecialFile(path);
  const std::string where = path.string();
  constexpr std::uint64_t magicBytes = 16;
  const PictureFormat format = pictureFormat(readFileBytes(path, where, magicBytes));
  if (std::find(formats.begin(), formats.end(), format) == formats.end()) {
    std::vector<std::string> names;
    for (const PictureFormat taken : formats) names.emplace_back(nameOf(taken));
    throw InputError(where, fmt::format("cannot be read as a picture: it is {}, expected {}", nameOf(format),
                                        fmt::join(names, ", ")));
  }
  if (format == PictureFormat::Png || format == PictureFormat::Jpeg)
    checkExtent(readFileBytes(path, where), where);
  if (format == PictureFormat::Hdr) checkHdrHeader(path);
  if (format == PictureFormat::Exr) checkExrHeaders(path);
  return format;
}

std::string lowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

const PictureChannel* PictureLayers::find(std::string_view name) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const PictureChannel& channel) { return channel.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

PictureLayers readPictureLayers(const std::filesystem::path& path) {
  requirePictureFile(path, {PictureFormat::Exr});
  return decodeLayers(readFileBytes(path, path.string()), path.string());
}

}  // namespace prelight
