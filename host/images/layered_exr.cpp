#include "images/layered_exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "images/exr_memory.h"

namespace prelight {

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
