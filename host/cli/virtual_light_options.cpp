#include "cli/virtual_light_options.h"

#include <fmt/format.h>

#include "cli/values.h"

namespace prelight::cli {

namespace {

constexpr const char* virtualLightHeading = "Instant radiosity (--shading instant)";
constexpr std::uint64_t mostVirtualPaths = 1024;  // there is room for their shadow maps
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
      fmt::format("greatest number of light paths that a frame of a window makes anew; 0: all (default {})",
                  options.renewals))
      ->group(virtualLightHeading);
  addRealNumber(
      app, "--virtual-nearest", {0.0, farthestNearest}, [&](double metres) { options.nearest = metres; },
      "metres: a nearer virtual light counts as if it were at this distance; 0 (default): the radius of the "
      "disc that the light represents")
      ->group(virtualLightHeading);
}

}  // namespace prelight::cli
