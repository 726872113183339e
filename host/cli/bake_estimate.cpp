#include "cli/bake_estimate.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <ctime>

namespace prelight::cli {
namespace {

constexpr std::uint64_t fewestRays = 16;
constexpr double sampleWork = 3.0;  // s that the second sample may take at least

/// A bake by so many rays a vertex. Its work is processor time where the device is a processor: what else the
/// machine does hardly changes that, and it grows by the same with every ray. Elsewhere it is the time that
/// passes.
struct Sample {
  BakeRun run;
  double rays = 0.0;
  double seconds = 0.0;
  double work = 0.0;
};

bool isProcessor(const Sample& sample) { return sample.run.device.kind == DeviceKind::Cpu; }

Sample bakeSample(Session& session, const LoadedScene& loaded, BakeRequest request,
                  const DeviceOptions& deviceOptions, std::uint64_t rays) {
  request.effort = {.rays = rays};
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t busy = std::clock();
  Sample sample{session.bake(loaded, request, deviceOptions), static_cast<double>(rays)};
  sample.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  sample.work =
      isProcessor(sample) ? static_cast<double>(std::clock() - busy) / CLOCKS_PER_SEC : sample.seconds;
  return sample;
}

/// Rays of a second sample: as many as take a few seconds, between a sixteenth and a quarter of all.
std::uint64_t raysOfSecond(const Sample& first, std::uint64_t rays) {
  const double all = static_cast<double>(rays);
  const double affordable = first.rays * sampleWork / std::max(first.work, 1e-3);
  const double chosen = std::max(2.0 * first.rays, std::clamp(affordable, all / 16.0, all / 4.0));
  return std::bit_floor(static_cast<std::uint64_t>(chosen));
}

/// Work follows the line through both samples; further rays keep all units of a processor busy.
BakeEstimate extrapolate(const Sample& few, Sample many, double rays, double spent) {
  const double slope = std::max(0.0, (many.work - few.work) / (many.rays - few.rays));
  const double further = slope * (rays - many.rays);
  const double units = isProcessor(many) ? std::max(1u, many.run.device.computeUnits) : 1.0;
  BakeEstimate estimate;
  estimate.spent = spent;
  estimate.seconds = many.seconds + further / units;
  if (isProcessor(many)) estimate.processorSeconds = many.work + further;
  estimate.rays = static_cast<std::uint64_t>(many.rays);
  estimate.sample = std::move(many.run);
  return estimate;
}

}  // namespace

BakeEstimate estimateBake(Session& session, const LoadedScene& loaded, const BakeRequest& request,
                          const DeviceOptions& deviceOptions) {
  const Effort& effort = request.effort;
  const bool counted = !effort.error && !effort.seconds;
  const bool few = counted && effort.rays < 4 * fewestRays;  // as good as a sample of themselves
  const std::uint64_t rays = few ? effort.rays : fewestRays;
  Sample first = bakeSample(session, loaded, request, deviceOptions, rays);
  if (!counted) return {std::move(first.run), rays, first.seconds, effort.seconds, std::nullopt};
  // The first bake of a scene loads kernels and wakes threads as it goes.
  Sample again = bakeSample(session, loaded, request, deviceOptions, rays);
  again.work = std::min(first.work, again.work);
  double spent = first.seconds + again.seconds;
  if (few) return extrapolate(Sample{}, std::move(again), static_cast<double>(rays), spent);
  Sample second = bakeSample(session, loaded, request, deviceOptions, raysOfSecond(again, effort.rays));
  spent += second.seconds;
  return extrapolate(again, std::move(second), static_cast<double>(effort.rays), spent);
}

}  // namespace prelight::cli
