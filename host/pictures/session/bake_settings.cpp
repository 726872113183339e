#include "pictures/session/bake_settings.h"

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
  add(request.ao && !request.cones, "BakeRequest::ao");
  add(request.cones, "BakeRequest::cones");
  add(request.horizons.sectors > 0, fmt::format("HorizonsRequest::sectors {}", request.horizons.sectors));
  add(request.sh.order > 0, fmt::format("ShRequest::order {}", request.sh.order));
  add(request.ch.order > 0, fmt::format("ChRequest::order {}", request.ch.order));
  add(request.nearLamps.shells > 0, fmt::format("NearLampsRequest::shells {}", request.nearLamps.shells));
  add(request.haar.size > 0, fmt::format("HaarRequest::size {}", request.haar.size));
  add(request.glossy.order > 0, fmt::format("GlossyRequest::order {}", request.glossy.order));
  add(request.occluders.wanted, "BakeRequest::occluders");
  add(request.volume.size > 0, fmt::format("VolumeRequest::size {}", request.volume.size));
  add(request.chartTransfer.size > 0,
      fmt::format("ChartTransferRequest::size {}", request.chartTransfer.size));
  add(request.chartTransfer.relief, "ChartTransferRequest::relief");
  add(request.lightGroups.wanted, "BakeRequest::lightGroups");
  add(request.radiosity.wanted, "BakeRequest::radiosity");
  add(request.lightMap.wanted, "BakeRequest::lightMap");
  add(request.lightMap.caustics, "LightMapRequest::caustics");
  add(bool(request.encodedLight),
      fmt::format("EncodedLightRequest::encodings {}", fmt::join(request.encodedLight.encodings, ",")));
  add(request.specular, request.glossyBounces ? "BakeRequest::glossyBounces" : "BakeRequest::specular");
  add(request.subsurface, "BakeRequest::subsurface");
  add(request.bounces > 0, fmt::format("BakeRequest::bounces {}", request.bounces));
  return text;
}

}  // namespace prelight::pictures
