#include "scene/gltf/other_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "prelight/error.h"

namespace prelight {

namespace {

/// A format, the ending of its files' names, and how they begin, where that tells.
struct OtherFormat {
  std::string_view name;
  std::string_view ending;
  std::string_view magic;
  bool assimpReads = true;  ///< the version of Debian 12
};

constexpr std::array<OtherFormat, 13> otherFormats = {{{"Wavefront OBJ", ".obj", ""},
                                                       {"PLY", ".ply", "ply\n"},
                                                       {"PLY", ".ply", "ply\r\n"},
                                                       {"STL", ".stl", "solid "},
                                                       {"FBX", ".fbx", "Kaydara FBX"},
                                                       {"COLLADA", ".dae", ""},
                                                       {"3DS", ".3ds", ""},
                                                       {"X3D", ".x3d", ""},
                                                       {"USD", ".usd", "PXR-USDC", false},
                                                       {"USD", ".usda", "#usda", false},
                                                       {"USD", ".usdc", "PXR-USDC", false},
                                                       {"USD", ".usdz", "PK\x03\x04", false},
                                                       {"Blender", ".blend", "BLENDER", false}}};

std::string endingOf(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

void refuseOtherFormats(std::span<const std::uint8_t> bytes, const std::string& file) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == std::string_view::npos || text[first] == '{') return;
  const std::string ending = endingOf(file);
  const auto begins = [&](const OtherFormat& f) { return !f.magic.empty() && text.starts_with(f.magic); };
  auto format = std::find_if(otherFormats.begin(), otherFormats.end(),
                             [&](const OtherFormat& f) { return f.ending == ending; });
  if (format == otherFormats.end()) format = std::find_if(otherFormats.begin(), otherFormats.end(), begins);
  if (format == otherFormats.end()) return;
  const std::string name = std::filesystem::path(file).filename().string();
  throw InputError(
      file, fmt::format("the file is {}, expected glTF 2.0 (.gltf or .glb)", format->name),
      format->assimpReads
          ? fmt::format("convert it with `assimp export {} OUT.glb`, or import it into Blender and export "
                        "it as glTF 2.0",
                        name)
          : std::string("open or import it in Blender and export it as glTF 2.0"));
}

}  // namespace prelight
