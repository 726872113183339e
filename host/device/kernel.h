#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

#include "device/buffer.h"

namespace prelight {

/// Work-items of a launch, rounded up to whole groups (kernels check their bound), and the lane that runs it.
struct WorkSize {
  WorkSize(std::size_t itemCount, std::size_t groupSize = 64, DeviceLane where = {})
      : items(itemCount), group(groupSize), lane(where) {}
  WorkSize(std::size_t itemCount, DeviceLane where) : WorkSize(itemCount, 64, where) {}

  std::size_t items;
  std::size_t group;
  DeviceLane lane;
};

/// Kind and size of an argument that a program passes to a kernel.
struct KernelArgument {
  bool isBuffer = false;
  std::size_t size = 0;  ///< bytes of the value, or of an element of the buffer
};

/// A kernel of an embedded file, built with `options`: the untyped part of Kernel.
class BuiltKernel {
 public:
  /// Builds the kernel. Throws Error(RuntimeFailure) when the number of its parameters is not that of
  /// `arguments` or when, as far as the device reports, a parameter is not a buffer or a value of the
  /// argument's size.
  BuiltKernel(DeviceContext& device, const std::string& file, const BuildOptions& options,
              const std::string& name, std::span<const KernelArgument> arguments);
  ~BuiltKernel();
  BuiltKernel(const BuiltKernel&) = delete;
  BuiltKernel& operator=(const BuiltKernel&) = delete;

  template <typename T>
  void set(std::uint32_t index, const T& value) {
    setValue(index, &value, sizeof(T));
  }
  template <typename T>
  void set(std::uint32_t index, const Buffer<T>& buffer) {
    setMemory(index, buffer.memory());
  }
  void launch(WorkSize size);

 private:
  void setValue(std::uint32_t index, const void* value, std::size_t bytes);
  void setMemory(std::uint32_t index, const DeviceMemory* memory);

  struct OpenCl;
  std::unique_ptr<OpenCl> opencl_;
};

template <typename T>
struct KernelArgumentOf {
  static_assert(std::is_trivially_copyable_v<T>, "kernels take buffers and plain values");
  static constexpr KernelArgument description{false, sizeof(T)};
};

template <typename T>
struct KernelArgumentOf<Buffer<T>> {
  static constexpr KernelArgument description{true, sizeof(T)};
};

/// A kernel with the types of its parameters in order: Buffer<T> for pointers and plain values for the rest.
/// A launch with other argument types does not compile.
template <typename... Parameters>
class Kernel {
  template <typename...>
  struct Types {};

 public:
  /// Makes an empty kernel, which must not be launched.
  Kernel() = default;

  /// Builds the kernel. Throws as BuiltKernel does.
  Kernel(DeviceContext& device, const std::string& file, const BuildOptions& options,
         const std::string& name) {
    const std::array<KernelArgument, sizeof...(Parameters)> arguments{
        KernelArgumentOf<Parameters>::description...};
    kernel_ = std::make_shared<BuiltKernel>(device, file, options, name, arguments);
  }

  explicit operator bool() const { return kernel_ != nullptr; }

  /// Does not wait.
  template <typename... Arguments>
  requires std::same_as<Types<Arguments...>, Types<Parameters...>>
  void launch(WorkSize size, const Arguments&... arguments) {
    std::uint32_t index = 0;
    (kernel_->set(index++, arguments), ...);
    kernel_->launch(size);
  }

 private:
  std::shared_ptr<BuiltKernel> kernel_;
};

/// Makes a kernel whose parameters have the arguments' types and launches it, for work that is done only
/// once. Does not wait.
template <typename... Arguments>
void launchOnce(DeviceContext& device, const std::string& file, const BuildOptions& options,
                const std::string& name, WorkSize size, const Arguments&... arguments) {
  Kernel<Arguments...>(device, file, options, name).launch(size, arguments...);
}

}  // namespace prelight
