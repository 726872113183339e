#include "cli/work_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "cli/console/console.h"

namespace prelight::cli {

Work measureWork(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t busy = std::clock();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          static_cast<double>(std::clock() - busy) / CLOCKS_PER_SEC};
}

WorkEstimate extrapolate(const WorkSample& few, const WorkSample& many, double size,
                         const DeviceInfo& device) {
  const bool processor = device.kind == DeviceKind::Cpu;
  const auto amount = [&](const Work& work) { return processor ? work.processor : work.seconds; };
  const double slope = std::max(0.0, (amount(many.work) - amount(few.work)) / (many.size - few.size));
  const double further = slope * (size - many.size);
  const double units = processor ? std::max(1u, device.computeUnits) : 1.0;
  WorkEstimate estimate{.seconds = many.work.seconds + further / units};
  if (processor) estimate.processorSeconds = many.work.processor + further;
  return estimate;
}

Work workSoFar(double seconds) { return {seconds, static_cast<double>(std::clock()) / CLOCKS_PER_SEC}; }

void addOnce(const Work& before, const Work& first, const Work& again, WorkEstimate& estimate) {
  const bool processor = estimate.processorSeconds.has_value();
  const double once =
      std::max(0.0, processor ? first.processor - again.processor : first.seconds - again.seconds);
  estimate.seconds += before.seconds + once;
  if (processor) *estimate.processorSeconds += before.processor + once;
}

std::string textOf(const WorkEstimate& estimate, const DeviceInfo& device) {
  const std::string busy = estimate.processorSeconds ? fmt::format(", {} of processor time",
                                                                   shortSeconds(*estimate.processorSeconds))
                                                     : std::string();
  return fmt::format("about {} with the machine to itself{}, on {}", shortSeconds(estimate.seconds), busy,
                     device.name);
}

}  // namespace prelight::cli
