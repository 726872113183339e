#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/colour.h"
#include "images/add_picture.h"
#include "images/exr.h"
#include "images/image_library.h"
#include "images/pixels.h"
#include "prelight/error.h"
#include "prelight/picture.h"

namespace prelight {

namespace {

// [1] Khronos, "PBR Neutral tone mapper", specification 1.0, 2024.

/// Returns the tone-mapped colour [1]: colours below 0.8 - 0.04 are only shifted, highlights are compressed
/// and desaturated.
glm::dvec3 pbrNeutral(glm::dvec3 color) {
  constexpr double f90 = 0.04;
  constexpr double startCompression = 0.8 - f90;
  constexpr double desaturation = 0.15;
  const double least = std::min({color.r, color.g, color.b});
  color -= least < 2.0 * f90 ? least - least * least / (4.0 * f90) : f90;
  const double peak = std::max({color.r, color.g, color.b});
  if (peak < startCompression) return color;
  constexpr double headroom = 1.0 - startCompression;
  const double newPeak = 1.0 - headroom * headroom / (peak + headroom - startCompression);
  const double grey = 1.0 - 1.0 / (desaturation * (peak - newPeak) + 1.0);
  return glm::mix(color * (newPeak / peak), glm::dvec3(newPeak), grey);
}

/// Largest radiance that the display transform distinguishes from infinity; avoids inf / inf.
constexpr float brightest = 1e6f;

std::vector<std::uint8_t> encode(const Picture& picture) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(picture.pixels.size() * 3);
  for (const glm::vec3& pixel : picture.pixels) {
    const glm::vec3 shown = toneMap(pixel);
    for (int c = 0; c < 3; ++c) bytes.push_back(static_cast<std::uint8_t>(std::lround(shown[c] * 255.0f)));
  }
  return bytes;
}

std::string layerOf(const PictureChannel& channel) { return channel.name.substr(0, channel.name.rfind('.')); }

/// Returns the channels of one layer, interleaved per texel.
std::vector<float> interleaved(std::span<const PictureChannel> channels) {
  std::vector<float> values(channels.size() * channels[0].values.size());
  for (std::size_t c = 0; c < channels.size(); ++c)
    for (std::size_t i = 0; i < channels[c].values.size(); ++i)
      values[i * channels.size() + c] = channels[c].values[i];
  return values;
}

/// Encodes R, G, B as the first part, so that readers of plain pictures open the file, and each further layer
/// as a part of its name.
std::vector<std::byte> encodeLayers(const std::filesystem::path& shown, const Picture& picture,
                                    std::span<const PictureChannel> channels) {
  const std::span<const float> rgb(&picture.pixels.data()->x, 3 * picture.pixels.size());
  std::vector<ExrPart> parts{{"rgb", {"R", "G", "B"}, rgb}};
  std::vector<std::vector<float>> values;
  values.reserve(channels.size());
  for (std::size_t first = 0, end = 0; first < channels.size(); first = end) {
    const std::string layer = layerOf(channels[first]);
    for (end = first + 1; end < channels.size() && layerOf(channels[end]) == layer;) ++end;
    const auto part = channels.subspan(first, end - first);
    std::vector<std::string> names;
    for (const PictureChannel& channel : part) names.push_back(channel.name);
    values.push_back(interleaved(part));
    parts.push_back({layer, std::move(names), values.back()});
  }
  return encodeLayeredExr(shown, picture.width, picture.height, parts);
}

}  // namespace

void writePicture(const std::filesystem::path& path, const Picture& picture) {
  OutputFiles files;
  addPicture(files, path, picture, {});
  files.commit();
}

void writePicture(const std::filesystem::path& path, const Picture& picture,
                  const std::vector<PictureChannel>& channels) {
  const std::string extension = lowerExtension(path);
  if (extension != ".exr")
    throw UsageError(path.string(),
                     "a picture of several layers is written as .exr, got '" + extension + "'");
  OutputFiles files;
  addPicture(files, path, picture, channels);
  files.commit();
}

void addPicture(OutputFiles& files, const std::filesystem::path& path, const Picture& picture,
                const std::vector<PictureChannel>& channels) {
  const std::string extension = lowerExtension(path);
  if (extension != ".exr" && extension != ".png")
    throw UsageError(path.string(), "a picture is written as .exr or .png, got '" + extension + "'");
  if (extension == ".exr")
    return files.add(
        path, channels.empty() ? encodePlainExr(path, picture) : encodeLayers(path, picture, channels));
  const std::vector<std::uint8_t> bytes =
      imageLibrary().encodePicturePng(path, picture.width, picture.height, encode(picture));
  files.add(path, std::as_bytes(std::span(bytes)));
}

Picture readPicture(const std::filesystem::path& path) {
  const std::string extension = lowerExtension(path);
  const bool linear = extension == ".exr" || extension == ".hdr";
  if (!linear && extension != ".png" && extension != ".jpg" && extension != ".jpeg") {
    throw InputError(path.string(), "a picture is an .exr, .hdr, .png or .jpg file, got '" + extension + "'");
  }
  Pixels pixels = readPixels(path);
  if (!linear) {
    for (glm::vec3& pixel : pixels.rgb) {
      for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(linearOfSrgb(pixel[c]));
    }
  }
  return {pixels.width, pixels.height, std::move(pixels.rgb)};
}

glm::vec3 toneMap(const glm::vec3& radiance) {
  glm::dvec3 color(0.0);
  for (int c = 0; c < 3; ++c) {
    if (radiance[c] > 0.0f) color[c] = std::min(radiance[c], brightest);  // false for NaN
  }
  color = pbrNeutral(color);
  return {srgbOfLinear(std::clamp(color.r, 0.0, 1.0)), srgbOfLinear(std::clamp(color.g, 0.0, 1.0)),
          srgbOfLinear(std::clamp(color.b, 0.0, 1.0))};
}

namespace {

/// Share of the pixels that must be below white.
constexpr double whiteShare = 0.98, white = 0.8;
/// Bounds of the picture's log-average luminance, within the keys 0.09 to 0.72 of [2].
constexpr double darkest = 0.13, lightest = 0.5;

// [2] Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002.

double luminanceOf(const glm::vec3& c) {
  const double y = 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z);
  return std::isfinite(y) ? y : 0.0;
}

/// Rounds to three digits, so that the printed number gives the same picture.
double roundedFactor(double factor) {
  const double unit = std::pow(10.0, std::floor(std::log10(factor)) - 2.0);
  return std::round(factor / unit) * unit;
}

}  // namespace

double meteredExposure(const Picture& picture) {
  std::vector<double> luminances;
  for (const glm::vec3& pixel : picture.pixels)
    if (const double y = luminanceOf(pixel); y > 0.0) luminances.push_back(y);
  if (luminances.empty()) return 1.0;
  double sum = 0.0;
  for (const double y : luminances) sum += std::log(y);
  const double mean = std::exp(sum / static_cast<double>(luminances.size()));
  const auto place =
      luminances.begin() + static_cast<std::ptrdiff_t>(whiteShare * double(luminances.size() - 1));
  std::nth_element(luminances.begin(), place, luminances.end());
  const double factor = std::clamp(white / *place, darkest / mean, lightest / mean);
  return std::isfinite(factor) && factor > 0.0
             ? std::clamp(roundedFactor(factor), leastExposure, mostExposure)
             : 1.0;
}

Picture exposed(Picture picture, double exposure) {
  if (exposure == 1.0) return picture;
  for (glm::vec3& pixel : picture.pixels) pixel *= static_cast<float>(exposure);
  return picture;
}

}  // namespace prelight
