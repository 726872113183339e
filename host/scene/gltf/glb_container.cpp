#include "scene/gltf/glb_container.h"

#include <fmt/format.h>

#include "prelight/error.h"

namespace prelight {

namespace {

constexpr std::uint32_t glbMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t jsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t binChunk = 0x004E4942;   // "BIN\0"
constexpr std::size_t headerBytes = 12;
constexpr std::size_t chunkHeaderBytes = 8;

std::uint32_t readWord(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return static_cast<std::uint32_t>(bytes[offset]) | static_cast<std::uint32_t>(bytes[offset + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[offset + 2]) << 16 |
         static_cast<std::uint32_t>(bytes[offset + 3]) << 24;
}

void appendWord(std::vector<std::uint8_t>& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

/// Returns the JSON text without padding. Some exporters pad the chunk with zeros instead of spaces.
std::string_view withoutPadding(std::string_view text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.remove_suffix(1);
  return text;
}

}  // namespace

bool isGlb(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 4 && readWord(bytes, 0) == glbMagic;
}

GlbChunks splitGlb(std::span<const std::uint8_t> bytes, const std::string& file, Warnings& warnings) {
  if (bytes.size() < headerBytes + chunkHeaderBytes) {
    throw InputError(file, fmt::format("truncated binary glTF: {} bytes, expected at least {}", bytes.size(),
                                       headerBytes + chunkHeaderBytes));
  }
  if (const std::uint32_t version = readWord(bytes, 4); version != 2) {
    throw InputError(file, fmt::format("binary glTF version {}, expected 2", version));
  }
  const std::uint32_t length = readWord(bytes, 8);
  if (length > bytes.size() || length < headerBytes + chunkHeaderBytes) {
    throw InputError(file,
                     fmt::format("binary glTF header says {} bytes, the file has {}", length, bytes.size()),
                     "the file is truncated or damaged; copy or export it again");
  }
  if (length < bytes.size()) {
    warnings.push_back(fmt::format("{}: {} bytes after the end of the binary glTF are ignored", file,
                                   bytes.size() - length));
    bytes = bytes.first(length);
  }
  GlbChunks chunks;
  std::size_t offset = headerBytes;
  for (int index = 0; bytes.size() - offset >= chunkHeaderBytes; ++index) {
    const std::size_t chunkLength = readWord(bytes, offset);
    const std::uint32_t type = readWord(bytes, offset + 4);
    offset += chunkHeaderBytes;
    if (chunkLength % 4 != 0)
      warnings.push_back(
          fmt::format("{}: chunk {} has {} bytes, expected a multiple of 4", file, index, chunkLength));
    if (chunkLength > bytes.size() - offset) {
      throw InputError(file, fmt::format("chunk {} says {} bytes, {} are left in the file", index,
                                         chunkLength, bytes.size() - offset));
    }
    const std::span<const std::uint8_t> data = bytes.subspan(offset, chunkLength);
    if ((type == jsonChunk) != (index == 0)) throw InputError(file, "expected one JSON chunk, and it first");
    if (index == 0) {
      chunks.json = withoutPadding({reinterpret_cast<const char*>(data.data()), data.size()});
    } else if (type == binChunk) {
      if (index > 1)
        warnings.push_back(fmt::format("{}: binary data in chunk {}, expected in chunk 1 alone{}", file,
                                       index, chunks.bin ? "; these are ignored" : ""));
      if (!chunks.bin) chunks.bin = data;
    }
    offset += chunkLength;
  }
  if (offset != bytes.size()) {
    throw InputError(file, fmt::format("{} stray bytes after the last chunk", bytes.size() - offset));
  }
  return chunks;
}

std::vector<std::uint8_t> makeGlbPrefix(std::string json, std::size_t binBytes, const std::string& file) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t paddedBin = (binBytes + 3) / 4 * 4;
  const std::size_t total =
      headerBytes + chunkHeaderBytes + json.size() + (binBytes > 0 ? chunkHeaderBytes + paddedBin : 0);
  if (total > UINT32_MAX) {
    throw Error(ExitCode::RuntimeFailure, file,
                fmt::format("cannot write {} bytes, binary glTF ends at 4 GiB", total),
                "bake fewer techniques or a lower order");
  }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(headerBytes + 2 * chunkHeaderBytes + json.size());
  appendWord(bytes, glbMagic);
  appendWord(bytes, 2);
  appendWord(bytes, static_cast<std::uint32_t>(total));
  appendWord(bytes, static_cast<std::uint32_t>(json.size()));
  appendWord(bytes, jsonChunk);
  bytes.insert(bytes.end(), json.begin(), json.end());
  if (binBytes > 0) {
    appendWord(bytes, static_cast<std::uint32_t>(paddedBin));
    appendWord(bytes, binChunk);
  }
  return bytes;
}

}  // namespace prelight
