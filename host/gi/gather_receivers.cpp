#include "gi/gather_receivers.h"

#include "receivers/sampling.h"
#include "receivers/texel_receiver.h"

namespace prelight {

std::vector<device::Receiver> gatherReceivers(const CompiledScene& compiled,
                                              std::span<const LightMapTexel> places, std::uint32_t count,
                                              std::uint32_t rays, std::uint64_t seed) {
  std::vector<device::Receiver> receivers;
  receivers.reserve(places.size() * count);
  const std::uint32_t folded =
      sampling::hashInteger(static_cast<std::uint32_t>(seed ^ (seed >> 32)) ^ 0x2545f491u);
  for (const LightMapTexel& place : places) {
    device::Receiver receiver = receiverAt(compiled, place);
    receiver.seed = sampling::hashInteger(place.texel + folded);
    for (std::uint32_t i = 0; i < count; ++i) {
      receiver.firstSample = i * rays;
      receivers.push_back(receiver);
    }
  }
  return receivers;
}

std::vector<device::DensityQuery> densityQueries(std::span<const device::Receiver> receivers,
                                                 AroundNormal normal, double radius,
                                                 std::span<const std::uint32_t> patches) {
  std::vector<device::DensityQuery> queries;
  queries.reserve(receivers.size());
  for (const device::Receiver& r : receivers) {
    device::DensityQuery query{};
    for (int k = 0; k < 3; ++k) {
      query.position[k] = r.position[k];
      query.normal[k] = normal == AroundNormal::Geometric ? r.geometricNormal[k] : r.normal[k];
    }
    query.triangle = r.triangle;
    query.radius = static_cast<float>(radius);
    query.patch = patches.empty() ? PRELIGHT_WHOLE_REGION : 1 + patches[queries.size()];
    queries.push_back(query);
  }
  return queries;
}

std::vector<device::DensityQuery> densityQueries(const CompiledScene& compiled,
                                                 std::span<const LightMapTexel> places, double radius,
                                                 std::span<const std::uint32_t> patches) {
  return densityQueries(gatherReceivers(compiled, places, 1, 0, 0), AroundNormal::Geometric, radius, patches);
}

}  // namespace prelight
