#include "benchmarks/lab/sh_device.h"

#include "basis/sh_evaluate.h"
#include "benchmarks/lab/harmonic_tables.h"
#include "benchmarks/lab/lab_kernels.h"
#include "device/kernel.h"

namespace prelight {
namespace {

/// `table`: makeMonicShTable() or makeMonicChTable().
std::vector<float> evaluateByTable(const Device& device, std::span<const glm::vec3> directions, int order,
                                   const std::vector<float>& table) {
  DeviceContext& context = device.context();
  std::vector<float> packed;
  for (const glm::vec3& w : directions) packed.insert(packed.end(), {w.x, w.y, w.z});
  Buffer<float> constants(context, std::span<const float>(table));
  Buffer<float> input(context, std::span<const float>(packed));
  Buffer<float> values(context, directions.size() * sh::coefficientCount(order));
  Kernel<std::uint32_t, std::int32_t, Buffer<float>, Buffer<float>, Buffer<float>> kernel(
      context, labKernel(context, "sh_evaluate_kernels.cl"), {}, "evaluateSh");
  kernel.launch(directions.size(), static_cast<std::uint32_t>(directions.size()), order, constants, input,
                values);
  return values.read();
}

}  // namespace

std::vector<float> sh::evaluateOnDevice(const Device& device, std::span<const glm::vec3> directions,
                                        int order) {
  checkOrder(order, "SH on the device");
  if (directions.empty()) return {};
  return evaluateByTable(device, directions, order, makeMonicShTable(order));
}

std::vector<float> ch::evaluateOnDevice(const Device& device, std::span<const glm::vec3> directions,
                                        int order) {
  sh::checkOrder(order, "CH on the device");
  if (directions.empty()) return {};
  return evaluateByTable(device, directions, order, makeMonicChTable(order));
}

}  // namespace prelight
