#include "gpu/medium_walker.h"

namespace prelight {

MediumWalker::MediumWalker(DeviceContext& device, const BuildOptions& options, std::uint32_t most)
    : most_(most),
      queue_(device, most),
      walks_(device, most),
      stepRays_(device, 2 * std::size_t{most}),
      stepWalks_(device, 2 * std::size_t{most}),
      stepHits_(device, most),
      stepMarks_(device, most),
      step_(device, "transport/walk_kernels.cl", options, "stepWalks") {}

void MediumWalker::run(const DeviceScene& scene, Tracer& tracer, Rays& rays, Hits& hits,
                       const Buffer<std::uint8_t>& marks, std::uint32_t count) {
  count = queue_.list(marks, count)[0];
  queue_.move(0, count, QueuedItems<device::Ray>{rays, 0, stepRays_},
              QueuedItems<device::MediumWalk>{walks_, 0, stepWalks_});
  queue_.move(0, count, QueuedItems<device::Hit>{hits, 0, stepHits_});
  while (count > 0) {
    step_.launch(count, count, most_, scene.layoutBuffer(), scene.surface(), scene.shading(), stepRays_,
                 stepHits_, stepWalks_, rays, hits, walks_, stepMarks_);
    count = queue_.list(stepMarks_, count)[0];
    queue_.move(0, count, QueuedItems<device::Ray>{stepRays_, most_, stepRays_},
                QueuedItems<device::MediumWalk>{stepWalks_, most_, stepWalks_});
    if (count > 0) tracer.traceClosest(stepRays_, stepHits_, count);
    rays_ += count;
  }
}

}  // namespace prelight
