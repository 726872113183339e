#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "encodings/registry/registry.h"

namespace prelight {

/// "ambient-cube, sh-3, ...".
std::string encodingNames();

/// Throws UsageError, which lists the names, for one that there is not. `option` is where it stands.
const Encoding& requireEncoding(std::string_view option, std::string_view name);

/// The encodings of these names. Throws UsageError for a name that there is not.
std::vector<const Encoding*> encodingsNamed(std::span<const std::string> names);

}  // namespace prelight
