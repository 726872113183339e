#include "viewer/core/shading.h"

#include <algorithm>
#include <vector>

#include "base/text.h"
#include "prelight/error.h"

namespace prelight::viewer {

const ShadingInfo& infoOf(Shading shading) { return shadings()[static_cast<std::size_t>(shading)]; }

std::string shadingNames() {
  std::string names;
  for (const ShadingInfo& info : shadings()) names += (names.empty() ? "" : ", ") + std::string(info.name());
  return names;
}

Shading parseShading(std::string_view name) {
  std::vector<std::string> names;
  for (const ShadingInfo& info : shadings()) {
    if (info.name() == name) return info.shading;
    names.emplace_back(info.name());
  }
  throw UsageError("--shading " + std::string(name), "unknown shading",
                   didYouMean(name, names) + "one of: " + shadingNames());
}

Shading carriedShading(const Bake& bake) {
  return *std::ranges::find_if(shadingsByPreference(),
                               [&](Shading shading) { return infoOf(shading).carriedBy(bake); });
}

}  // namespace prelight::viewer
