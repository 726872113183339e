#include <cstring>

#include "base/parallel.h"
#include "benchmarks/lab/lab_kernels.h"
#include "benchmarks/measure.h"
#include "benchmarks/relight_cases.h"
#include "benchmarks/suites.h"
#include "benchmarks/take_turns.h"
#include "device/kernel.h"

namespace prelight::benchmarks {

namespace {

/// Copies as many bytes as the widest transfer holds, by the plainest kernel there is: what the machine's
/// memory gives, read and written.
class DeviceCopy {
 public:
  DeviceCopy(DeviceContext& device, std::size_t bytes)
      : device_(device),
        lines_(bytes / (16 * sizeof(float))),
        in_(device, lines_ * 16),
        out_(device, lines_ * 16),
        kernel_(device, labKernel(device, "light_kernels.cl"), {}, "copyLanes") {
    in_.fill(1.0f);
  }

  std::size_t bytesMoved() const { return 2 * in_.bytes(); }

  void run() {
    kernel_.launch(lines_, in_, static_cast<std::uint32_t>(lines_), out_);
    device_.finish();
  }

 private:
  DeviceContext& device_;
  std::size_t lines_;
  Buffer<float> in_, out_;
  Kernel<Buffer<float>, std::uint32_t, Buffer<float>> kernel_;
};

/// The same by memcpy on all cores.
class HostCopy {
 public:
  explicit HostCopy(std::size_t bytes) : in_(bytes, 1), out_(bytes) {}

  std::size_t bytesMoved() const { return 2 * in_.size(); }

  void run() {
    const std::size_t grain = (in_.size() + hardwareThreads() - 1) / hardwareThreads();
    parallelRanges(in_.size(), grain, [&](std::size_t begin, std::size_t end) {
      std::memcpy(out_.data() + begin, in_.data() + begin, end - begin);
    });
  }

 private:
  std::vector<char> in_, out_;
};

}  // namespace

void runRelightSuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run) {
  std::vector<RelightCase> cases = transferCases(device, options.relightVertices);
  for (RelightCase& light : lightCases(device, options.relightSkyRows)) cases.push_back(std::move(light));
  DeviceCopy deviceCopy(device.context(), options.relightVertices * 108 * sizeof(float));
  HostCopy hostCopy(options.relightVertices * 108 * sizeof(float));
  run.report("bench relight", 0.0);

  std::vector<Contender> contenders;
  for (const RelightCase& one : cases) contenders.push_back({one.name, [&one](std::size_t) { one.run(); }});
  contenders.push_back({"copy", [&](std::size_t) { deviceCopy.run(); }});
  contenders.push_back({"memcpy", [&](std::size_t) { hostCopy.run(); }});
  takeTurns(contenders, 1, options.relightRounds, run);
  run.report("bench relight", 1.0);

  const Contender& copy = contenders[cases.size()];
  std::vector<BenchmarkResult>& results = run.results();
  const auto add = [&](const Contender& own, std::size_t bytes) {
    const double byteRatio = double(bytes) / double(deviceCopy.bytesMoved());
    results.push_back({"relight", own.name, "bandwidth", double(bytes) / medianSeconds(own.seconds, 1), "B/s",
                       "copy", medianRatio(own.seconds, copy.seconds) * byteRatio});
    // Of processor time: what other programs take meanwhile is not in it.
    results.push_back({"relight", own.name, "bandwidth a core", double(bytes) / median(own.cpuSeconds), "B/s",
                       "copy", medianRatio(own.cpuSeconds, copy.cpuSeconds) * byteRatio});
  };
  add(copy, deviceCopy.bytesMoved());
  add(contenders.back(), hostCopy.bytesMoved());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    add(contenders[i], cases[i].bytes);
    results.push_back({"relight",
                       cases[i].name,
                       "rate",
                       double(cases[i].items) / medianSeconds(contenders[i].seconds, 1),
                       "items/s",
                       {},
                       {}});
    results.push_back({"relight", cases[i].name, "relative error", cases[i].error, "1", {}, {}});
  }
}

}  // namespace prelight::benchmarks
