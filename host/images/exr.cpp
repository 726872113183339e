#include "images/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVersion.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "prelight/error.h"

namespace prelight {

namespace {

constexpr std::array<const char*, 3> names = {"R", "G", "B"};

void write(ExrMemory& stream, const Picture& picture) {
  Imf::Header header(picture.width, picture.height);
  // No compression: ZIP takes 25 ms for 256 x 256 noisy pixels and saves 6 % of the bytes.
  header.compression() = Imf::NO_COMPRESSION;
  Imf::FrameBuffer pixels;
  constexpr std::size_t pixel = sizeof(glm::vec3);
  for (int c = 0; c < 3; ++c) {
    header.channels().insert(names[static_cast<std::size_t>(c)], Imf::Channel(Imf::FLOAT));
    pixels.insert(names[static_cast<std::size_t>(c)],
                  Imf::Slice::Make(Imf::FLOAT, &picture.pixels.data()->x + c,
                                   {{0, 0}, {picture.width - 1, picture.height - 1}}, pixel,
                                   pixel * static_cast<std::size_t>(picture.width)));
  }
  Imf::OutputFile file(stream, header, 0);
  file.setFrameBuffer(pixels);
  file.writePixels(picture.height);
}

/// Returns whether a file has one part, its data fills the display window, and its only channels are R, G and
/// B at every pixel.
bool isPlain(const Imf::InputFile& file) {
  if (Imf::isMultiPart(file.version()) || Imf::isTiled(file.version()) || Imf::isNonImage(file.version()))
    return false;
  const Imf::Header& header = file.header();
  if (header.dataWindow() != header.displayWindow() || header.dataWindow().min != Imath::V2i(0, 0))
    return false;
  int found = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c, ++found) {
    const Imf::Channel& channel = c.channel();
    if (channel.xSampling != 1 || channel.ySampling != 1 || channel.type == Imf::UINT) return false;
    if (std::find_if(names.begin(), names.end(),
                     [&](const char* name) { return std::strcmp(name, c.name()) == 0; }) == names.end())
      return false;
  }
  return found == static_cast<int>(names.size());
}

/// Bytes that OpenEXR reads.
class ExrSource final : public Imf::IStream {
 public:
  explicit ExrSource(std::span<const std::uint8_t> bytes) : IStream("memory"), bytes_(bytes) {}

  bool read(char out[], int size) override {
    const auto count = static_cast<std::size_t>(size);
    if (at_ > bytes_.size() || count > bytes_.size() - at_) throw std::runtime_error("cut short");
    std::memcpy(out, bytes_.data() + at_, count);
    at_ += count;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::uint64_t at_ = 0;
};

std::optional<Pixels> decode(std::span<const std::uint8_t> bytes) {
  ExrSource source(bytes);
  Imf::InputFile file(source);
  if (!isPlain(file)) return std::nullopt;
  const Imath::V2i last = file.header().dataWindow().max;
  const auto width = static_cast<std::uint64_t>(last.x) + 1, height = static_cast<std::uint64_t>(last.y) + 1;
  const std::uint64_t texels = width * height;
  if (texels > mostPictureTexels || 3 * texels > mostNumbers(bytes.size())) return std::nullopt;
  Pixels pixels{last.x + 1, last.y + 1, std::vector<glm::vec3>(texels)};
  Imf::FrameBuffer buffer;
  for (int c = 0; c < 3; ++c)
    buffer.insert(names[static_cast<std::size_t>(c)],
                  Imf::Slice::Make(Imf::FLOAT, &pixels.rgb.data()->x + c, file.header().dataWindow(),
                                   sizeof(glm::vec3), sizeof(glm::vec3) * width));
  file.setFrameBuffer(buffer);
  file.readPixels(0, last.y);
  return pixels;
}

}  // namespace

std::optional<Pixels> decodePlainExr(std::span<const std::uint8_t> bytes) {
  try {
    return decode(bytes);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return std::nullopt;  // the other reader reports the error
  }
}

std::vector<std::byte> encodePlainExr(const std::filesystem::path& shown, const Picture& picture) {
  return encodeExrFile(
      shown, 24 * static_cast<std::size_t>(picture.height) + picture.pixels.size() * sizeof(glm::vec3),
      [&](ExrMemory& memory) { write(memory, picture); });
}

namespace {

Imf::Header headerOf(const ExrPart& part, int width, int height) {
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setName(part.name);
  header.setType(Imf::SCANLINEIMAGE);
  header.insert("capDate", Imf::StringAttribute());  // files of earlier versions have one, too
  for (const std::string& channel : part.channels)
    header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  return header;
}

Imf::FrameBuffer pixelsOf(const ExrPart& part, int width, int height) {
  Imf::FrameBuffer pixels;
  const std::size_t pixel = part.channels.size() * sizeof(float);
  for (std::size_t c = 0; c < part.channels.size(); ++c)
    pixels.insert(part.channels[c],
                  Imf::Slice::Make(Imf::FLOAT, part.values.data() + c, {{0, 0}, {width - 1, height - 1}},
                                   pixel, pixel * static_cast<std::size_t>(width)));
  return pixels;
}

void write(ExrMemory& memory, int width, int height, std::span<const ExrPart> parts) {
  std::vector<Imf::Header> headers;
  for (const ExrPart& part : parts) headers.push_back(headerOf(part, width, height));
  Imf::MultiPartOutputFile file(memory, headers.data(), static_cast<int>(headers.size()), false, 0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Imf::OutputPart part(file, static_cast<int>(i));
    part.setFrameBuffer(pixelsOf(parts[i], width, height));
    part.writePixels(height);
  }
}

}  // namespace

std::vector<std::byte> encodeLayeredExr(const std::filesystem::path& shown, int width, int height,
                                        std::span<const ExrPart> parts) {
  std::size_t numbers = 0;
  for (const ExrPart& part : parts) numbers += part.values.size();
  return encodeExrFile(shown, numbers * sizeof(float),
                       [&](ExrMemory& memory) { write(memory, width, height, parts); });
}

}  // namespace prelight
