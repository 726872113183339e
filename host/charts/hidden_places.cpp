#include "charts/hidden_places.h"

#include <algorithm>

#include "receivers/sampling.h"
#include "receivers/texel_receiver.h"

namespace prelight {

namespace {

CastOptions castOptions() {
  CastOptions options;
  options.raysPerReceiver = HiddenPlaces::raysPerPlace;
  options.marksInside = true;
  return options;
}

}  // namespace

HiddenPlaces::HiddenPlaces(const CompiledScene& scene, Tracer& tracer, std::uint64_t seed)
    : scene_(scene),
      caster_(scene, tracer, castOptions()),
      seed_(sampling::hashInteger(static_cast<std::uint32_t>(seed) ^
                                  sampling::hashInteger(static_cast<std::uint32_t>(seed >> 32) + 0x1d5e7u))) {
}

void HiddenPlaces::mark(std::span<const LightMapTexel> places, std::span<std::uint8_t> marks) {
  for (std::size_t first = 0; first < places.size(); first += caster_.blockSize()) {
    const auto block =
        places.subspan(first, std::min<std::size_t>(caster_.blockSize(), places.size() - first));
    receivers_.clear();
    for (const LightMapTexel& place : block) {
      receivers_.push_back(receiverAt(scene_, place));
      receivers_.back().seed = seed_ ^ sampling::hashInteger(place.texel);
    }
    caster_.cast(receivers_, cast_);
    for (std::size_t i = 0; i < block.size(); ++i)
      if (cast_.inside[i] != 0) marks[first + i] = 1;
  }
}

}  // namespace prelight
