#include "gi/light_passes.h"

#include <fmt/format.h>

#include "photon/casters.h"

namespace prelight {

std::vector<PlannedPass> lightPasses(const CompiledScene& compiled, const TransportScene& scene) {
  const bool lit = scene.lights().groupCount > 0;
  const bool scatters = scene.features().scatters;
  const bool casters = !causticCasters(compiled).empty();
  return {{Pass::IndirectLight, lit && scatters,
           !lit       ? "nothing gives light"
           : scatters ? "photons, density estimation and final gathering"
                      : "no surface scatters light"},
          {Pass::CausticPhotons, lit && casters,
           !casters ? "no surface is a mirror, glass or nearly a mirror"
           : lit    ? "some surface is a mirror, glass or nearly a mirror"
                    : "nothing gives light"}};
}

PlannedPass planBacks(std::uint32_t charts) {
  return {Pass::BacksOfOneSidedSurfaces, charts > 0,
          charts > 0 ? fmt::format("photons met them: {} charts have texels on their backs, too", charts)
                     : "no photon met one: their backs have no texels"};
}

}  // namespace prelight
