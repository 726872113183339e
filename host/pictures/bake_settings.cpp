#include "pictures/bake_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace prelight::pictures {
namespace {

constexpr int defaultShOrder = 3;
constexpr int defaultBounces = 1;

}  // namespace

void BakeSettings::addTo(DeviceOptions& device) const {
  device.cacheKernels = cacheKernels;
  device.dumpKernels = dumpKernels;
}

void useDefaultTechniques(BakeRequest& request) {
  request.ao = true;
  request.sh.order = defaultShOrder;
  if (request.bounces == 0) request.bounces = defaultBounces;
}

std::string techniqueText(const BakeRequest& request) {
  std::string text;
  const auto add = [&](bool given, const std::string& option) {
    if (given) text += (text.empty() ? "" : " ") + option;
  };
  add(request.ao && !request.cones, "--ao");
  add(request.cones, "--cones");
  add(request.horizons.sectors > 0, fmt::format("--horizons {}", request.horizons.sectors));
  add(request.sh.order > 0, fmt::format("--sh {}", request.sh.order));
  add(request.ch.order > 0, fmt::format("--ch {}", request.ch.order));
  add(request.nearLamps.shells > 0, fmt::format("--near-lamps {}", request.nearLamps.shells));
  add(request.haar.size > 0, fmt::format("--haar {}", request.haar.size));
  add(request.glossy.order > 0, fmt::format("--glossy {}", request.glossy.order));
  add(request.occluders.wanted, "--vo");
  add(request.volume.size > 0, fmt::format("--volume {}", request.volume.size));
  add(request.chartTransfer.size > 0, fmt::format("--texels {}", request.chartTransfer.size));
  add(request.chartTransfer.relief, "--relief");
  add(request.lightGroups.wanted, "--light-groups");
  add(request.radiosity.wanted, "--radiosity");
  add(request.lightMap.wanted, "--lightmap");
  add(request.lightMap.caustics, "--caustics");
  add(bool(request.encodedLight), fmt::format("--encode {}", fmt::join(request.encodedLight.encodings, ",")));
  add(request.specular, request.glossyBounces ? "--glossy-bounces" : "--specular-transport");
  add(request.subsurface, "--subsurface-transport");
  add(request.bounces > 0, fmt::format("--bounces {}", request.bounces));
  return text;
}

}  // namespace prelight::pictures
