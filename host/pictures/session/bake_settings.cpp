#include "pictures/session/bake_settings.h"

#include <fmt/format.h>

#include "options/shared_bake_options.h"
#include "techniques/registry/registry.h"

namespace prelight::pictures {
namespace {

constexpr int defaultShOrder = 3;
constexpr int defaultBounces = 1;

/// Returns the value of an option with a space before it; an empty text for a flag.
std::string valueText(const Option<BakeRequest>& row, const BakeRequest& request) {
  switch (row.kind) {
    case OptionKind::Flag:
      return {};
    case OptionKind::Number:
      return fmt::format(" {}", row.get(request).value());
    case OptionKind::Choice:
      return fmt::format(" {}", row.choices[static_cast<std::size_t>(row.get(request).value())].name);
    case OptionKind::Own:
      break;
  }
  return " " + row.text(request);
}

}  // namespace

void BakeSettings::addTo(DeviceOptions& device) const {
  device.cacheKernels = cacheKernels;
  device.dumpKernels = dumpKernels;
}

void useDefaultTechniques(BakeRequest& request) {
  request.ao = true;
  request.sh.order = defaultShOrder;
  if (request.bounces == 0 && request.visibility == Visibility::Rays) request.bounces = defaultBounces;
}

std::string techniqueText(const BakeRequest& request) {
  std::string text;
  for (const auto rows : {techniqueOptions(), lightOptions()})
    for (const Option<BakeRequest>& row : rows)
      if (row.commandLine == nullptr && row.isSet(request))
        text += fmt::format("{}{}{}", text.empty() ? "" : " ", row.field, valueText(row, request));
  return text;
}

}  // namespace prelight::pictures
