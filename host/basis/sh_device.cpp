#include "basis/sh_device.h"

#include "basis/sh_evaluate.h"
#include "basis/sh_table.h"
#include "device/buffer.h"

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
  cl::Kernel kernel(context.program("basis/sh_evaluate_kernels.cl", {}), "evaluateSh");
  setArguments(kernel, static_cast<cl_uint>(directions.size()), static_cast<cl_int>(order), table.get(),
               input.get(), values.get());
  context.launch(kernel, directions.size(), 64);
  return values.read();
}

}  // namespace prelight::sh
