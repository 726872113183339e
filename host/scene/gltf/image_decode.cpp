#include "scene/gltf/image_decode.h"

#include <fmt/format.h>

#include "images/picture_header.h"
#include "prelight/error.h"
#include "scene/gltf/gltf_validate.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

std::span<const std::uint8_t> imageBytes(const GltfDocument& document, std::size_t index) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  const JsonCursor reference = root.at("images").at(index).at("bufferView");
  const JsonCursor view =
      root.at("bufferViews").at(reference.asIndex(root.countOf("bufferViews"), "buffer view"));
  validateBufferView(root, view);
  return std::span(document.bin)
      .subspan(view.unsignedOr("byteOffset", 0), view.at("byteLength").asUnsigned());
}

namespace {

std::string placeOf(const GltfDocument& document, std::size_t index) {
  return fmt::format("{}: /images/{}", document.path.string(), index);
}

/// Returns the number of texels for which decoding an image would allocate memory; 0 when it is missing or
/// broken.
std::uint64_t texelsToDecode(const GltfDocument& document, std::size_t index) {
  const std::string where = placeOf(document, index);
  if (!document.json.at("images").at(index).contains("bufferView")) return 0;
  const std::span<const std::uint8_t> bytes = imageBytes(document, index);
  const PictureFormat format = pictureFormat(bytes);
  if (format != PictureFormat::Unknown && !isDecoded(format))
    throw InputError(where,
                     fmt::format("the picture is {}, expected PNG, JPEG, WebP, AVIF or KTX2", nameOf(format)),
                     "convert the picture");
  const std::optional<PictureExtent> extent = pictureExtent(bytes);
  if (!extent || bytes.size() < extent->leastBytes) return 0;
  requireDecodable(*extent, where);
  return extent->texels();
}

}  // namespace

void checkImages(const GltfDocument& document, const std::vector<bool>& used) {
  constexpr std::uint64_t anyDocument = std::uint64_t{1} << 27;
  constexpr std::uint64_t texelsOfByte = 256;
  const std::uint64_t most = anyDocument + texelsOfByte * document.bin.size();
  std::uint64_t texels = 0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) texels += texelsToDecode(document, i);
    if (texels > most)
      throw InputError(
          placeOf(document, i),
          fmt::format("the images so far have {} texels, expected at most {} for {} bytes of data", texels,
                      most, document.bin.size()),
          "scale the pictures down");
  }
}

Image whiteImage(const std::string& name) { return {name, 1, 1, {255, 255, 255, 255}}; }

Image loadImage(const GltfDocument& document, std::size_t index, Warnings& warnings) {
  const auto& json = document.json.at("images").at(index);
  const std::string name = json.value("name", "");
  const std::string where = placeOf(document, index);
  if (!json.contains("bufferView")) {
    // An image with a URI was reported when it could not be embedded.
    if (!json.contains("uri"))
      warnings.push_back(where + ": the image names no data; a white texel stands in");
    return whiteImage(name);
  }
  try {
    Image image = decodeImage(imageBytes(document, index), where);
    image.name = name;
    return image;
  } catch (const InputError& error) {
    warnings.push_back(fmt::format("{}; a white texel stands in for the image", error.what()));
    return whiteImage(name);
  }
}

}  // namespace prelight
