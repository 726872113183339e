#include "benchmarks/lab/lab_kernels.h"

namespace prelight {

std::string labKernel(DeviceContext& device, const std::string& file) {
  for (const auto& [path, text] : labKernelSources()) device.addFile(path, text);
  return "lab/kernels/" + file;
}

}  // namespace prelight
