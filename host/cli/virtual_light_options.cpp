#include "cli/virtual_light_options.h"

#include <fmt/format.h>

#include "cli/picture_options.h"
#include "cli/values.h"

namespace prelight::cli {

namespace {

constexpr const char* virtualLightHeading = "Instant radiosity (--shading instant)";
constexpr std::uint64_t mostVirtualPaths = 1024;  // whose maps have room
constexpr double farthestNearest = 1e6;

}  // namespace

void addVirtualLightOptions(CLI::App& app, VirtualLightOptions& options) {
  addWholeNumber(
      app, "--virtual-lights", {1, mostVirtualPaths}, [&](std::uint64_t n) { options.paths = n; },
      fmt::format("light paths that leave a virtual light wherever they meet a diffuse surface (default {})",
                  options.paths))
      ->group(virtualLightHeading);
  addWholeNumber(
      app, "--virtual-renewals", {0, mostVirtualPaths},
      [&](std::uint64_t n) { options.renewals = static_cast<std::uint32_t>(n); },
      fmt::format("of them that a frame of a window makes anew at most; 0: all (default {})",
                  options.renewals))
      ->group(virtualLightHeading);
  addRealNumber(
      app, "--virtual-nearest", {0.0, farthestNearest}, [&](double metres) { options.nearest = metres; },
      "metres: a virtual light that is nearer counts as at that distance; 0 (default): the radius of the "
      "disc that each stands for")
      ->group(virtualLightHeading);
}

std::unique_ptr<FollowingVirtualLights> virtualLights(Session& session, const PictureOptions& options,
                                                      const ShadedScene& shaded) {
  auto following = std::make_unique<FollowingVirtualLights>();
  CompiledScene compiled = followUnderLights(session, options, shaded, *following);
  VirtualLightOptions request = options.virtualLights;
  request.seed = options.bake.request.seed;
  session.times().measure("light", [&] {
    following->lights.emplace(shaded.loaded.scene, std::move(compiled),
                              following->sky ? &*following->sky : nullptr, shaded.render.skyRotation, request,
                              *following->device, session.progress());
  });
  session.progress().clear();
  return following;
}

}  // namespace prelight::cli
