#pragma once

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

class OutputFiles;

/// Writes by extension: .exr is linear radiance (R,G,B, 32-bit float), .png is tone-mapped (toneMap) 8-bit
/// sRGB. Writes beside and renames. Throws UsageError for another extension, Error when it cannot be written.
void writePicture(const std::filesystem::path& path, const Picture& picture);

/// Writes an .exr file: R, G, B, and each further layer ("variance"), whose channels follow one another, as a
/// part of its name, so that programs that read plain RGB pictures open it.
void writePicture(const std::filesystem::path& path, const Picture& picture,
                  const std::vector<PictureChannel>& channels);

/// As one of several files, base/atomic_file.h. Layers are left out of a .png.
void addPicture(OutputFiles& files, const std::filesystem::path& path, const Picture& picture,
                const std::vector<PictureChannel>& channels);

/// Reads .exr, .hdr as linear radiance and .png, .jpg as sRGB decoded to linear. Throws InputError.
Picture readPicture(const std::filesystem::path& path);

/// The display transform of .png files and of the viewer: exposure 1, Khronos PBR Neutral tone mapping
/// (colours below about 0.8 keep hue and saturation, highlights are compressed into [0,1]), then sRGB
/// encoding. Negative and NaN channels count as 0.
glm::vec3 toneMap(const glm::vec3& radiance);

}  // namespace prelight
