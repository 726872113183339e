#include "device/kernel.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "device/opencl_context.h"
#include "prelight/error.h"

namespace prelight {

namespace {

/// Returns the bytes of a value of a built-in scalar or vector type of OpenCL C, or nothing for other types.
std::optional<std::size_t> sizeOfBuiltIn(std::string type) {
  std::size_t lanes = 1;
  const std::size_t digits = type.find_last_not_of("0123456789") + 1;
  if (digits < type.size()) {
    lanes = std::stoul(type.substr(digits));
    type.resize(digits);
  }
  if (lanes == 3) lanes = 4;
  for (const auto& [name, size] : {std::pair{"char", 1},
                                   {"uchar", 1},
                                   {"short", 2},
                                   {"ushort", 2},
                                   {"int", 4},
                                   {"uint", 4},
                                   {"float", 4},
                                   {"long", 8},
                                   {"ulong", 8},
                                   {"double", 8}})
    if (type == name) return lanes * static_cast<std::size_t>(size);
  return std::nullopt;
}

/// Returns how an argument differs from the kernel's parameter, or an empty text if it does not or the device
/// does not tell.
std::string disagreement(const cl::Kernel& kernel, std::uint32_t index, const KernelArgument& argument) {
  try {
    const auto space = kernel.getArgInfo<CL_KERNEL_ARG_ADDRESS_QUALIFIER>(index);
    const bool takesBuffer = space == CL_KERNEL_ARG_ADDRESS_GLOBAL || space == CL_KERNEL_ARG_ADDRESS_CONSTANT;
    if (takesBuffer != argument.isBuffer)
      return fmt::format("expects a {}, got a {}", takesBuffer ? "buffer" : "value",
                         argument.isBuffer ? "buffer" : "value");
    if (takesBuffer) return {};
    std::string type = kernel.getArgInfo<CL_KERNEL_ARG_TYPE_NAME>(index);
    while (!type.empty() && type.back() == '\0') type.pop_back();
    const auto size = sizeOfBuiltIn(type);
    if (size && *size != argument.size)
      return fmt::format("expects a {} of {} bytes, got {} bytes", type, *size, argument.size);
  } catch (const cl::Error&) {
    // Argument information is optional in built and loaded programs.
  }
  return {};
}

}  // namespace

struct BuiltKernel::OpenCl {
  OpenClContext& context;
  cl::Kernel kernel;
};

BuiltKernel::BuiltKernel(DeviceContext& device, const std::string& file, const BuildOptions& options,
                         const std::string& name, std::span<const KernelArgument> arguments)
    : opencl_(std::make_unique<OpenCl>(OpenCl{device.opencl(), calling([&] {
                                                return cl::Kernel(device.opencl().program(file, options),
                                                                  name.c_str());
                                              })})) {
  const std::string where = fmt::format("kernel {} of {}", name, file);
  const auto count = calling([&] { return opencl_->kernel.getInfo<CL_KERNEL_NUM_ARGS>(); });
  if (count != arguments.size())
    throw Error(ExitCode::RuntimeFailure, where,
                fmt::format("takes {} arguments, got {}", count, arguments.size()));
  for (std::uint32_t i = 0; i < count; ++i)
    if (const std::string wrong = disagreement(opencl_->kernel, i, arguments[i]); !wrong.empty())
      throw Error(ExitCode::RuntimeFailure, where, fmt::format("parameter {} {}", i, wrong));
}

BuiltKernel::~BuiltKernel() = default;

void BuiltKernel::setValue(std::uint32_t index, const void* value, std::size_t bytes) {
  calling([&] { opencl_->kernel.setArg(index, bytes, value); });
}

void BuiltKernel::setMemory(std::uint32_t index, const DeviceMemory* memory) {
  const cl::Buffer none;
  calling([&] { opencl_->kernel.setArg(index, memory != nullptr ? memory->opencl().buffer : none); });
}

void BuiltKernel::launch(WorkSize size) {
  opencl_->context.launch(opencl_->kernel, size.items, size.group, size.lane);
}

}  // namespace prelight
