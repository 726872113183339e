#include "scene/image_decode.h"

#include <fmt/format.h>

#include "base/error.h"
#include "images/image_library.h"

namespace prelight {

namespace {

bool startsWith(std::span<const std::uint8_t> bytes, std::string_view magic, std::size_t offset = 0) {
  if (bytes.size() < offset + magic.size()) return false;
  return std::string_view(reinterpret_cast<const char*>(bytes.data()) + offset, magic.size()) == magic;
}

}  // namespace

std::string imageMimeType(std::span<const std::uint8_t> bytes) {
  if (startsWith(bytes, "\x89PNG")) return "image/png";
  if (startsWith(bytes, "\xFF\xD8\xFF")) return "image/jpeg";
  if (startsWith(bytes, "RIFF") && startsWith(bytes, "WEBP", 8)) return "image/webp";
  if (startsWith(bytes, "\xABKTX 20")) return "image/ktx2";
  if (startsWith(bytes, "DDS ")) return "image/vnd-ms.dds";
  if (startsWith(bytes, "BM")) return "image/bmp";
  return {};
}

Image decodeImage(std::span<const std::uint8_t> bytes, const std::string& where) {
  const std::string mime = imageMimeType(bytes);
  if (mime.empty()) throw InputError(where, "not a PNG, JPEG or other known picture");
  const std::string format = mime == "image/vnd-ms.dds" ? "dds" : mime.substr(mime.find('/') + 1);
  return imageLibrary().decodeImage(bytes, "x." + format, where);
}

Image whiteImage(const std::string& name) { return {name, 1, 1, {255, 255, 255, 255}}; }

Image loadImage(const GltfDocument& document, std::size_t index, Warnings& warnings) {
  const auto& json = document.json.at("images").at(index);
  const std::string name = json.value("name", "");
  const std::string where = fmt::format("{}: /images/{}", document.path.string(), index);
  if (!json.contains("bufferView")) {
    // An image with a URI has been complained about when it could not be embedded.
    if (!json.contains("uri"))
      warnings.push_back(where + ": the image names no data; a white texel stands in");
    return whiteImage(name);
  }
  const auto& view = document.json.at("bufferViews").at(json.at("bufferView").get<std::size_t>());
  const std::size_t offset = view.value("byteOffset", std::size_t{0});
  const std::span<const std::uint8_t> bytes(document.bin.data() + offset,
                                            view.at("byteLength").get<std::size_t>());
  try {
    Image image = decodeImage(bytes, where);
    image.name = name;
    return image;
  } catch (const InputError& error) {
    warnings.push_back(fmt::format("{}; a white texel stands in for the image", error.what()));
    return whiteImage(name);
  }
}

}  // namespace prelight
