// Texts of URIs: percent signs, base64 and data URIs.
#include <string_view>

#include "fuzz/target.h"
#include "scene/gltf/uri.h"

namespace prelight::fuzz {

namespace {

void readUri(Bytes input) {
  const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
  require(percentDecode(text).size() <= text.size(), "decoded texts are no longer than their source");
  (void)decodeBase64(text);
  (void)uriScheme(text);
  if (isDataUri(text)) (void)parseDataUri(text);
}

}  // namespace

Target uri() { return {"uri", readUri}; }

}  // namespace prelight::fuzz
