#include "gi/guided_gather.h"

#include <algorithm>

namespace prelight {

GuidedGather::GuidedGather(const FinalGather& gather, std::span<const float> guides, std::size_t receivers)
    : guides_(guides), irradiance_(receivers) {
  DeviceContext& device = gather.device();
  const std::size_t most = std::min<std::size_t>(receivers, gather.receiversAtOnce());
  guideBuffer_ = Buffer<float>(device, PRELIGHT_GUIDE_CELLS * most);
  weights_ = Buffer<float>(device, most * gather.raysPerReceiver());
  sums_ = Buffer<float>(device, 3 * most);
  const char* file = "gather/guided_kernels.cl";
  generate_ = {device, file, {}, "generateGuidedRays"};
  sum_ = {device, file, {}, "sumGuided"};
}

void GuidedGather::makeRays(const GatherBlock& block) {
  guideBuffer_.write(guides_.subspan(PRELIGHT_GUIDE_CELLS * block.first, PRELIGHT_GUIDE_CELLS * block.count));
  generate_.launch(block.rayCount / 8, block.parameters, block.receivers, guideBuffer_, block.rays, weights_);
}

void GuidedGather::sum(const GatherBlock& block) {
  sum_.launch(block.count, block.parameters, block.radiances, weights_, sums_);
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  sums_.read(std::span(&irradiance_[block.first].x, 3 * block.count));
}

}  // namespace prelight
