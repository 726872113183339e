#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace prelight {

/// A rendered picture of linear radiance, rows top to bottom.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> pixels;  ///< [row][column]
};

/// A further channel of an .exr file, one value a pixel.
struct PictureChannel {
  std::string name;           ///< "variance.Y"
  std::vector<float> values;  ///< [row][column]
};

/// Writes by extension: .exr is linear radiance (R,G,B, 32-bit float), .png is tone-mapped (toneMap) 8-bit
/// sRGB. Writes beside and renames. Throws UsageError for another extension, Error when it cannot be written.
void writePicture(const std::filesystem::path& path, const Picture& picture);

/// Writes an .exr file: R, G, B, and each further layer ("variance"), whose channels follow one another, as a
/// part of its name, so that programs that read plain RGB pictures open it.
void writePicture(const std::filesystem::path& path, const Picture& picture,
                  const std::vector<PictureChannel>& channels);

/// Reads .exr, .hdr as linear radiance and .png, .jpg as sRGB decoded to linear. Throws InputError.
Picture readPicture(const std::filesystem::path& path);

/// The display transform of .png files and of the viewer: exposure 1, Khronos PBR Neutral tone mapping
/// (colours below about 0.8 keep hue and saturation, highlights are compressed into [0,1]), then sRGB
/// encoding. Negative and NaN channels count as 0.
glm::vec3 toneMap(const glm::vec3& radiance);

/// Bounds of an exposure, a factor of radiance.
constexpr double leastExposure = 1e-9, mostExposure = 1e9;

/// The exposure at which a picture shows well: 98 % of its lit pixels are below white, and their log-average
/// is neither black nor white. Has three digits. 1 for a black picture; depends on the pixels alone.
double meteredExposure(const Picture& picture);

/// A picture whose radiance is multiplied by an exposure, for .png; 1 leaves it as it is.
Picture exposed(Picture picture, double exposure);

/// A decoded picture: RGBA, 8 bits a channel, rows top to bottom, values as stored in the file
/// (colour textures are sRGB-encoded). An unreadable image is replaced by one white texel and a warning.
struct Image {
  std::string name;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  ///< [row][column][channel]
};

/// Equirectangular sky of linear radiance. +Y up; the centre column looks along -Z and u grows towards +X.
struct Environment {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> radiance;  ///< [row][column], row 0 at +Y, W/(m2 sr), finite and >= 0

  /// World direction of the point (u, v) in [0,1]^2 of the map.
  static glm::dvec3 direction(double u, double v);
  /// Inverse of direction(): (u, v) of a unit world direction.
  static glm::dvec2 coordinates(const glm::dvec3& direction);
};

/// Reads .hdr or .exr. Throws InputError, also for texels that are not radiance (docs/conventions.md, "Sky").
Environment readEnvironment(const std::filesystem::path& path);

/// A sky of one radiance everywhere.
Environment constantEnvironment(const glm::vec3& radiance);

/// A photographer's studio for models that bring no light along: soft boxes above, at the left, at the right
/// and behind, pale walls and a darker floor. Made by a formula (docs/conventions.md, "Sky").
Environment studioEnvironment();

}  // namespace prelight
