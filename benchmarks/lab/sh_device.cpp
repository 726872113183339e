#include "benchmarks/lab/sh_device.h"

#include "basis/sh_evaluate.h"
#include "basis/sh_table.h"
#include "benchmarks/lab/lab_kernels.h"
#include "device/kernel.h"

namespace prelight::sh {

std::vector<float> evaluateOnDevice(const Device& device, std::span<const glm::vec3> directions, int order) {
  checkOrder(order, "SH on the device");
  if (directions.empty()) return {};
  DeviceContext& context = device.context();
  std::vector<float> packed;
  for (const glm::vec3& w : directions) packed.insert(packed.end(), {w.x, w.y, w.z});
  Buffer<float> table(context, std::span<const float>(makeMonicShTable(order)));
  Buffer<float> input(context, std::span<const float>(packed));
  Buffer<float> values(context, directions.size() * coefficientCount(order));
  Kernel<std::uint32_t, std::int32_t, Buffer<float>, Buffer<float>, Buffer<float>> kernel(
      context, labKernel(context, "sh_evaluate_kernels.cl"), {}, "evaluateSh");
  kernel.launch(directions.size(), static_cast<std::uint32_t>(directions.size()), order, table, input,
                values);
  return values.read();
}

}  // namespace prelight::sh
