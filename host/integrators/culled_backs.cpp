#include "integrators/culled_backs.h"

namespace prelight::reference {

using namespace device;

namespace {

constexpr std::uint32_t kind = 0;  ///< kind of marks that is used
constexpr int mostBacks = 64;      ///< most successive backs that are skipped; the next one is shown

}  // namespace

CulledBacks::CulledBacks(TransportScene& scene, const char* file, const BuildOptions& options,
                         std::uint32_t most)
    : scene_(scene), most_(most) {
  beyond_.rays = Buffer<Ray>(scene.context(), most);
  list_ = {scene.context(), file, options, "listCulled"};
  keep_ = {scene.context(), file, options, "keepBeyond"};
}

void CulledBacks::lookThrough(const Step& step, Buffer<std::uint8_t>& marks, WorkQueue& queue) {
  const DeviceScene& scene = scene_.handle();
  for (int back = 0; back < mostBacks; ++back) {
    list_.launch(step.count, step.parameters, step.count, scene.surface(), scene.shading(), step.rays,
                 step.hits, step.numbers, step.paths, beyond_.rays, marks);
    const std::uint32_t count = queue.list(marks, step.count)[kind];
    if (count == 0) return;
    if (beyond_.listed.size() == 0) {
      beyond_.listed = Buffer<Ray>(scene_.context(), most_);
      beyond_.hits = Buffer<Hit>(scene_.context(), most_);
    }
    queue.move(kind, count, QueuedItems<Ray>{beyond_.rays, 0, beyond_.listed});
    scene_.tracer().traceClosest(beyond_.listed, beyond_.hits, count, 0);
    rays_ += count;
    keep_.launch(count, count, queue.first(kind), queue.lists(), beyond_.hits, step.hits);
  }
}

}  // namespace prelight::reference
