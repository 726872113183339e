#include "scene/gltf/other_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <utility>

#include "prelight/error.h"

namespace prelight {

namespace {

/// A format, the ending of its files' names, and their first bytes, if these identify it.
struct OtherFormat {
  std::string_view name;
  std::string_view ending;
  std::string_view magic;
  bool assimpReads = true;  ///< the version in Debian 12 reads it
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

/// A file type that is no model, its first bytes, and what to do about it.
struct NoModel {
  std::string_view name;
  std::string_view magic;
  std::string_view remedy;
};

constexpr std::string_view givePicture =
    "name the scene; a picture may be a sky, RadiosityRequest::environment";
constexpr std::string_view giveScene = "name the scene";
constexpr std::string_view unpack = "unpack it and name the .gltf or .glb in it";
constexpr std::string_view download = "download the file itself: a browser was given a page in its place";

constexpr std::array<NoModel, 17> noModels = {
    {{"a PNG picture", "\x89PNG", giveScene},
     {"a JPEG picture", "\xFF\xD8\xFF", giveScene},
     {"a GIF picture", "GIF8", giveScene},
     {"a WebP picture", "RIFF", giveScene},
     {"an OpenEXR picture", "v/1\x01", givePicture},
     {"a Radiance picture", "#?RADIANCE", givePicture},
     {"a Radiance picture", "#?RGBE", givePicture},
     {"a KTX2 texture", "\xABKTX 20", giveScene},
     {"a DDS texture", "DDS ", giveScene},
     {"a PDF", "%PDF-", giveScene},
     {"a web page", "<!DOCTYPE html", download},
     {"a web page", "<!doctype html", download},
     {"a web page", "<html", download},
     {"a pointer of Git LFS", "version https://git-lfs", "fetch the file itself with `git lfs pull`"},
     {"packed by gzip", "\x1F\x8B", unpack},
     {"packed by Zstandard", "\x28\xB5\x2F\xFD", unpack},
     {"packed by xz",
      "\xFD"
      "7zXZ",
      unpack}}};
constexpr std::string_view zipMagic = "PK\x03\x04", usdz = ".usdz";
constexpr std::array<std::string_view, 2> utf16Marks = {"\xFF\xFE", "\xFE\xFF"};

[[noreturn]] void refuse(const std::string& file, std::string_view name, std::string remedy) {
  throw InputError(file, fmt::format("the file is {}, expected glTF 2.0 (.gltf or .glb)", name),
                   std::move(remedy));
}

void refuseNoModels(std::string_view text, const std::string& file, const std::string& ending) {
  for (const NoModel& other : noModels)
    if (text.starts_with(other.magic)) refuse(file, other.name, std::string(other.remedy));
  if (text.starts_with(zipMagic) && ending != usdz) refuse(file, "a zip archive", std::string(unpack));
  for (const std::string_view mark : utf16Marks)
    if (text.starts_with(mark)) refuse(file, "text in UTF-16", "save it in UTF-8");
}

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
  refuseNoModels(text, file, ending);
  const auto begins = [&](const OtherFormat& f) { return !f.magic.empty() && text.starts_with(f.magic); };
  auto format = std::find_if(otherFormats.begin(), otherFormats.end(),
                             [&](const OtherFormat& f) { return f.ending == ending; });
  if (format == otherFormats.end()) format = std::find_if(otherFormats.begin(), otherFormats.end(), begins);
  if (format == otherFormats.end()) return;
  const std::string name = std::filesystem::path(file).filename().string();
  refuse(file, format->name,
         format->assimpReads
             ? fmt::format("convert it with `assimp export {} OUT.glb`, or import it into Blender and export "
                           "it as glTF 2.0",
                           name)
             : std::string("open or import it in Blender and export it as glTF 2.0"));
}

}  // namespace prelight
