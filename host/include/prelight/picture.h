#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace prelight {

/// A picture of linear radiance, rows top to bottom.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> pixels;  ///< [row][column]
};

/// An additional channel of an .exr file, with one value per pixel.
struct PictureChannel {
  std::string name;           ///< such as "variance.Y"
  std::vector<float> values;  ///< [row][column]
};

/// Writes a picture in the format of the extension: .exr holds linear radiance (R, G, B, 32-bit float), .png
/// tone-mapped (toneMap) 8-bit sRGB. The file appears whole or not at all. Throws UsageError for another
/// extension and Error when the file cannot be written.
void writePicture(const std::filesystem::path& path, const Picture& picture);

/// Writes an .exr file with R, G, B and further channels. Channels of one layer ("variance") must be
/// adjacent; each layer becomes a separate part of the file, so that programs that read plain RGB pictures
/// still open it.
void writePicture(const std::filesystem::path& path, const Picture& picture,
                  const std::vector<PictureChannel>& channels);

/// Reads .exr and .hdr as linear radiance, .png and .jpg as sRGB that is decoded to linear. Throws
/// InputError.
Picture readPicture(const std::filesystem::path& path);

/// Returns the display colour of .png files and the viewer: exposure 1, Khronos PBR Neutral tone mapping
/// (colours below about 0.8 keep hue and saturation, highlights are compressed into [0,1]), then sRGB
/// encoding. Negative and NaN channels count as 0.
glm::vec3 toneMap(const glm::vec3& radiance);

/// Bounds of an exposure, which is a factor of radiance.
constexpr double leastExposure = 1e-9, mostExposure = 1e9;

/// Returns the exposure, rounded to three digits, at which 98 % of a picture's lit pixels are below white and
/// their log-average is neither black nor white. It is 1 for a black picture and depends on the pixels alone.
double meteredExposure(const Picture& picture);

/// Returns a picture whose radiance is multiplied by an exposure, for .png.
Picture exposed(Picture picture, double exposure);

/// A decoded image: RGBA, 8 bits per channel, rows top to bottom, values as stored in the file (colour
/// textures are sRGB-encoded). Unreadable images are replaced by one white texel, with a warning.
struct Image {
  std::string name;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  ///< [row][column][channel]
};

/// An equirectangular sky of linear radiance. +Y is up; the centre column looks along -Z, and u grows towards
/// +X.
struct Environment {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> radiance;  ///< [row][column], row 0 at +Y, W/(m2 sr), finite and >= 0

  /// Returns the world direction of the point (u, v) in [0,1]^2 of the map.
  static glm::dvec3 direction(double u, double v);
  /// Returns the (u, v) of a unit world direction: the inverse of direction().
  static glm::dvec2 coordinates(const glm::dvec3& direction);
};

/// Reads a sky from .hdr or .exr. Throws InputError, also for texels that are not radiance
/// (docs/conventions.md, "Sky").
Environment readEnvironment(const std::filesystem::path& path);

/// Returns a sky of uniform radiance.
Environment constantEnvironment(const glm::vec3& radiance);

/// Returns a photographer's studio for models that come without light: soft boxes above, left, right and
/// behind, pale walls and a darker floor. It is defined by a formula (docs/conventions.md, "Sky").
Environment studioEnvironment();

}  // namespace prelight
