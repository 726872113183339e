#include "viewer/options/lamp_files.h"

#include <string>
#include <vector>

#include "base/files.h"
#include "scene/codecs/ies_profile.h"
#include "scene/light_profile.h"

namespace prelight::viewer {

std::shared_ptr<const LightProfile> readProfile(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = readFileBytes(file, file.string(), mostProfileBytes);
  return std::make_shared<const LightProfile>(
      parseIesProfile(std::string(bytes.begin(), bytes.end()), file.string()));
}

std::shared_ptr<const Picture> readCookie(const std::filesystem::path& file) {
  return std::make_shared<const Picture>(cookieOf(readPicture(file)));
}

}  // namespace prelight::viewer
