#include "techniques/encoded_light/encoding_names.h"

#include <fmt/format.h>

#include "base/text.h"
#include "prelight/error.h"

namespace prelight {

std::string encodingNames() {
  std::string names;
  for (const Encoding& encoding : encodings())
    names += (names.empty() ? "" : ", ") + std::string(encoding.name);
  return names;
}

const Encoding& requireEncoding(std::string_view option, std::string_view name) {
  if (const Encoding* encoding = encodingNamed(name)) return *encoding;
  std::vector<std::string> names;
  for (const Encoding& encoding : encodings()) names.emplace_back(encoding.name);
  throw UsageError(fmt::format("{} {}", option, name), "unknown encoding",
                   didYouMean(name, names) + "one of: " + encodingNames());
}

std::vector<const Encoding*> encodingsNamed(std::span<const std::string> names) {
  std::vector<const Encoding*> found;
  for (const std::string& name : names) found.push_back(&requireEncoding("encoding", name));
  return found;
}

}  // namespace prelight
