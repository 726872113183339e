// The program prelight-compiler, which the library starts to compile kernels (device/compiler_process.h). A
// compiler that crashes ends this process instead of the one that bakes or draws.
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/large_stack.h"
#include "device/compile_channel.h"
#include "device/opencl_devices.h"
#include "processes/channel.h"

namespace prelight {

namespace {

/// Returns the device that has the index and identity in `name`, or nothing.
std::optional<cl::Device> findByName(const std::string& name) {
  const std::vector<FoundDevice> devices = findDevices();
  const auto found = std::find_if(devices.begin(), devices.end(), [&](const FoundDevice& device) {
    return nameForCompiler(device.info) == name;
  });
  if (found == devices.end()) return std::nullopt;
  return found->device;
}

std::string verdict(CompileVerdict kind, const std::string& text) { return static_cast<char>(kind) + text; }

std::string binaryOf(const cl::Program& program) {
  const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
  if (binaries.empty()) return {};
  return {binaries.front().begin(), binaries.front().end()};
}

std::string compile(const cl::Context& context, const cl::Device& device, const std::string& options,
                    const std::string& source) {
  cl::Program program(context, source);
  try {
    program.build({device}, options.c_str());
    return verdict(CompileVerdict::Built, binaryOf(program));
  } catch (const cl::Error&) {
    return verdict(CompileVerdict::Refused, program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device));
  }
}

/// Answers jobs until the library closes its end.
void serve(int channel) {
  const std::optional<std::string> name = receiveText(channel);
  if (!name) return;
  const std::optional<cl::Device> device = findByName(*name);
  if (!device) {
    sendText(channel, "no such device");
    return;
  }
  const cl::Context context(*device);
  if (!sendText(channel, "")) return;
  while (awaitData(channel, patience)) {
    const std::optional<std::string> options = receiveText(channel);
    const std::optional<std::string> source = options ? receiveText(channel) : std::nullopt;
    if (!source || !sendText(channel, compile(context, *device, *options, *source))) return;
  }
}

int run() {
  return runStarted("prelight-compiler: Prelight's library starts this program to compile kernels", serve);
}

}  // namespace

}  // namespace prelight

int main() {
  // Skips the runtimes' cleanup at exit, which would only cost time.
  _exit(prelight::onLargeStack(prelight::run));
}
