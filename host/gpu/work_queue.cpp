#include "gpu/work_queue.h"

namespace prelight {

namespace {

std::uint32_t runsOf(std::uint32_t count) { return (count + PRELIGHT_QUEUE_RUN - 1) / PRELIGHT_QUEUE_RUN; }

constexpr const char* file = "core/queue_kernels.cl";

constexpr KernelArgument words{true, sizeof(std::uint32_t)};
constexpr std::array<KernelArgument, 6> moveArguments{
    KernelArgument{false, sizeof(device::QueueMove)}, words, words, words, words, words};

}  // namespace

WorkQueue::WorkQueue(DeviceContext& device, std::uint32_t most)
    : most_(most),
      counts_(device, runsOf(most) + 1),
      lists_(device, kinds * std::size_t{most}),
      count_(device, file, {}, "countMarks"),
      start_(device, file, {}, "startRuns"),
      list_(device, file, {}, "listMarked"),
      few_(device, file, {}, "listFew"),
      move_(std::make_unique<BuiltKernel>(device, file, BuildOptions{}, "moveListed", moveArguments)) {}

std::array<std::uint32_t, WorkQueue::kinds> WorkQueue::list(const Buffer<std::uint8_t>& marks,
                                                            std::uint32_t count) {
  const std::uint32_t runs = count <= PRELIGHT_QUEUE_FEW ? 0 : runsOf(count);
  if (count == 0) return {};
  if (runs == 0) {
    few_.launch({1, 1}, count, most_, marks, counts_, lists_);
  } else {
    count_.launch(runs, count, marks, counts_);
    start_.launch({1, 1}, runs, counts_);
    list_.launch(runs, count, most_, marks, counts_, lists_);
  }
  glm::uvec4 totals{0u};
  counts_.read(std::span(&totals, 1), runs);
  return {totals.x, totals.y, totals.z, totals.w};
}

}  // namespace prelight
