#include "scene/image_decode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/error.h"

namespace prelight {

namespace {

bool startsWith(std::span<const std::uint8_t> bytes, std::string_view magic, std::size_t offset = 0) {
  if (bytes.size() < offset + magic.size()) return false;
  return std::string_view(reinterpret_cast<const char*>(bytes.data()) + offset, magic.size()) == magic;
}

/// A grey, grey-alpha, RGB or RGBA texel as RGBA.
void spreadChannels(const std::vector<std::uint8_t>& from, int channels, std::vector<std::uint8_t>& rgba) {
  const std::size_t texels = rgba.size() / 4;
  for (std::size_t i = 0; i < texels; ++i) {
    const std::uint8_t* in = &from[i * static_cast<std::size_t>(channels)];
    std::uint8_t* out = &rgba[i * 4];
    const bool grey = channels < 3;
    out[0] = in[0];
    out[1] = grey ? in[0] : in[1];
    out[2] = grey ? in[0] : in[2];
    out[3] = channels == 2 ? in[1] : channels >= 4 ? in[3] : std::uint8_t{255};
  }
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
  constexpr std::int64_t maxTexels = std::int64_t{1} << 28;
  const std::string mime = imageMimeType(bytes);
  if (mime.empty()) throw InputError(where, "not a PNG, JPEG or other known picture");
  OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
  OIIO::Filesystem::IOProxy* proxy = &memory;
  OIIO::ImageSpec wishes;
  // The readers look for the proxy among the wishes and forget the one that open() was given.
  wishes.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  // The name only chooses the format; nothing of that name is opened.
  const std::string name = mime == "image/vnd-ms.dds" ? "x.dds" : "x." + mime.substr(mime.find('/') + 1);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(name, &wishes, &memory);
  if (!input) throw InputError(where, "cannot decode the picture: " + OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  const std::int64_t texels = std::int64_t{spec.width} * spec.height;
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || texels > maxTexels) {
    throw InputError(where,
                     fmt::format("a picture of {} x {} texels is not usable", spec.width, spec.height));
  }
  const int channels = std::min(spec.nchannels, 4);
  std::vector<std::uint8_t> stored(static_cast<std::size_t>(texels) * static_cast<std::size_t>(channels));
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, stored.data())) {
    throw InputError(where, "cannot decode the picture: " + input->geterror());
  }
  Image image;
  image.width = spec.width;
  image.height = spec.height;
  image.rgba.resize(static_cast<std::size_t>(texels) * 4);
  spreadChannels(stored, channels, image.rgba);
  return image;
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
