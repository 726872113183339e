#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "images/module/functions.h"
#include "prelight/error.h"

namespace prelight::images {

namespace {

/// One image of a file.
struct Part {
  OIIO::ImageSpec spec;
  OIIO::TypeDesc type;
  const void* pixels;
};

[[noreturn]] void fail(const std::filesystem::path& shown, const std::string& reason) {
  throw Error(ExitCode::RuntimeFailure, shown.string(), "cannot be written: " + reason);
}

void writeParts(const std::filesystem::path& shown, OIIO::ImageOutput& output, const std::string& name,
                const std::vector<Part>& parts) {
  std::vector<OIIO::ImageSpec> specs;
  for (const Part& part : parts) specs.push_back(part.spec);
  const bool one = parts.size() == 1;
  if (!(one ? output.open(name, specs[0]) : output.open(name, static_cast<int>(specs.size()), specs.data())))
    fail(shown, output.geterror());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0 && !output.open(name, specs[i], OIIO::ImageOutput::AppendSubimage))
      fail(shown, output.geterror());
    if (!output.write_image(parts[i].type, parts[i].pixels)) fail(shown, output.geterror());
  }
  if (!output.close()) fail(shown, output.geterror());
}

/// A file that lies in memory alone.
class MemoryFile {
 public:
  explicit MemoryFile(const std::filesystem::path& shown)
      : descriptor_(::memfd_create("picture", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail(shown, std::strerror(errno));
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  std::vector<std::uint8_t> bytes(const std::filesystem::path& shown) const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) fail(shown, std::strerror(errno));
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(status.st_size));
    for (std::size_t at = 0; at < bytes.size();) {
      const ssize_t count = ::pread(descriptor_, &bytes[at], bytes.size() - at, static_cast<off_t>(at));
      if (count <= 0) fail(shown, std::strerror(errno));
      at += static_cast<std::size_t>(count);
    }
    return bytes;
  }

 private:
  int descriptor_;
};

}  // namespace

std::vector<std::uint8_t> encodePicturePng(const std::filesystem::path& shown, int width, int height,
                                           std::span<const std::uint8_t> rgb) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const std::string format = "picture.png";  // chooses the format; nothing of that name is made
  const auto output = OIIO::ImageOutput::create(format, &memory);
  if (!output) fail(shown, OIIO::geterror());
  writeParts(shown, *output, format, {{spec, OIIO::TypeDesc::UINT8, rgb.data()}});
  return bytes;
}

std::vector<std::uint8_t> encodeExr(const std::filesystem::path& shown, int width, int height,
                                    std::span<const ExrPart> parts) {
  std::vector<Part> written;
  for (const ExrPart& part : parts) {
    OIIO::ImageSpec spec(width, height, static_cast<int>(part.channels.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = part.channels;
    spec.attribute("compression", "zip");
    // Else OpenImageIO notes the time, and equal pictures would be unequal files.
    spec.attribute("DateTime", "");
    if (!part.name.empty()) spec.attribute("oiio:subimagename", part.name);
    written.push_back({std::move(spec), OIIO::TypeDesc::FLOAT, part.values.data()});
  }
  // OpenImageIO writes files of several parts to nothing but files.
  const MemoryFile memory(shown);
  const auto output = OIIO::ImageOutput::create("picture.exr");
  if (!output) fail(shown, OIIO::geterror());
  writeParts(shown, *output, memory.name(), written);
  return memory.bytes(shown);
}

}  // namespace prelight::images
