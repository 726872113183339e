#include "techniques/light_map/inside_part.h"

namespace prelight {

InsidePart::InsidePart(const CompiledScene& scene, Tracer& tracer, std::uint64_t seed)
    : places_(scene, tracer, seed) {}

void InsidePart::add(std::span<const LightMapTexel> texels, int, std::span<float>,
                     std::span<std::uint8_t> hidden) {
  places_.mark(texels, hidden);
  rays_ += texels.size() * HiddenPlaces::raysPerPlace;
}

}  // namespace prelight
