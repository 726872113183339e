#include "io/values/transfer_extension.h"

namespace prelight {

std::optional<JsonCursor> transferExtension(const JsonCursor& object) {
  const auto extensions = object.find("extensions");
  return extensions ? extensions->find(transferExtensionName) : std::nullopt;
}

}  // namespace prelight
