#include "cli/commands/bake_estimate.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "cli/work_estimate.h"

namespace prelight::cli {
namespace {

constexpr std::uint64_t fewestRays = 16;
constexpr double sampleWork = 3.0;  // //s that the second sample should take at least

/// A trial bake with a given number of rays per vertex.
struct Sample {
  BakeRun run = {};
  WorkSample sample = {};
};

Sample bakeSample(Session& session, const LoadedScene& loaded, BakeRequest request,
                  const DeviceOptions& deviceOptions, std::uint64_t rays) {
  request.effort = {.rays = rays};
  Sample sample{.sample = {.size = static_cast<double>(rays)}};
  sample.sample.work = measureWork([&] { sample.run = session.bake(loaded, request, deviceOptions); });
  return sample;
}

/// Returns the rays of the second sample: as many as take a few seconds, between a sixteenth and a quarter of
/// all.
std::uint64_t raysOfSecond(const Sample& first, std::uint64_t rays) {
  const double all = static_cast<double>(rays);
  const Work& work = first.sample.work;
  const double taken = first.run.device.kind == DeviceKind::Cpu ? work.processor : work.seconds;
  const double affordable = first.sample.size * sampleWork / std::max(taken, 1e-3);
  const double chosen = std::max(2.0 * first.sample.size, std::clamp(affordable, all / 16.0, all / 4.0));
  return std::bit_floor(static_cast<std::uint64_t>(chosen));
}

BakeEstimate estimated(const WorkSample& few, Sample many, double rays, double spent, const Work& first,
                       const Work& again) {
  WorkEstimate work = extrapolate(few, many.sample, rays, many.run.device);
  addOnce({}, first, again, work);
  return {std::move(many.run), static_cast<std::uint64_t>(many.sample.size), spent, work.seconds,
          work.processorSeconds};
}

}  // namespace

BakeEstimate estimateBake(Session& session, const LoadedScene& loaded, const BakeRequest& request,
                          const DeviceOptions& deviceOptions) {
  const Effort& effort = request.effort;
  const bool counted = !effort.error && !effort.seconds;
  // With so few rays, samples would cost as much as the bake.
  const bool few = counted && effort.rays < 4 * fewestRays;
  const std::uint64_t rays = few ? effort.rays : fewestRays;
  Sample first = bakeSample(session, loaded, request, deviceOptions, rays);
  if (!counted) return {std::move(first.run), rays, first.sample.work.seconds, effort.seconds, std::nullopt};
  // The first bake is slower, because it loads kernels and wakes threads, and is therefore done again.
  Sample again = bakeSample(session, loaded, request, deviceOptions, rays);
  const Work warm = again.sample.work;
  double spent = first.sample.work.seconds + warm.seconds;
  if (few) return estimated({}, std::move(again), static_cast<double>(rays), spent, first.sample.work, warm);
  Sample second = bakeSample(session, loaded, request, deviceOptions, raysOfSecond(again, effort.rays));
  spent += second.sample.work.seconds;
  return estimated(again.sample, std::move(second), static_cast<double>(effort.rays), spent,
                   first.sample.work, warm);
}

}  // namespace prelight::cli
