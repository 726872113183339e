#include "cast/schedule.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "fit/error_estimate.h"
#include "prelight/hemisphere_renderer.h"

namespace prelight {

namespace {

constexpr double castShareOfTime = 0.75;   // the rest is for fits and bounces
constexpr double mostSeconds = 1e9;        // clocks count to 292 years
constexpr double timedPassRays = 1 << 18;  // about a tenth of a second on two cores

/// Makes a schedule of drawn views, each of which stands for many rays.
void countViews(const BakeRequest& request, std::uint32_t vertices, Schedule& schedule) {
  schedule.raysPerReceiver = 128;  // a view counts as at least that many where rays are counted
  // Texels of views err alike where what hides is even, so that receivers agree on more than is true.
  schedule.leastError = 0.01;
  const double perPass = double(vertices) / double(schedule.passes);
  if (request.effort.error)
    schedule.receiversPerPass = perPass;
  else if (request.effort.seconds)
    schedule.receiversPerPass = std::min(perPass, timedPassRays / HemisphereRenderer::directions);
  else
    schedule.receiversPerPass = perPass * double(request.effort.rays) / HemisphereRenderer::directions;
}

/// Several receivers a vertex beat one with many rays, as long as each has enough for low discrepancy to
/// show: 64 rays do up to the point where a vertex has 64 receivers of twice as many.
std::uint32_t raysOfReceiver(std::uint64_t raysOfVertex) {
  std::uint32_t rays = 16;  // below, the control variate is visibly biased (docs/notes/accuracy.md)
  while (rays < 64 && 32ull * rays <= raysOfVertex) rays *= 2;
  return raysOfVertex >= 64ull * 128 ? 128 : rays;
}

}  // namespace

Schedule makeSchedule(const BakeRequest& request, std::uint32_t vertices,
                      std::chrono::steady_clock::time_point start) {
  Schedule schedule;
  schedule.seed = request.seed;
  schedule.passes = errorGroups;
  if (request.effort.error || request.effort.seconds) schedule.replicates = errorGroups;
  if (request.effort.error) {
    // Small receivers and a small first round: what is easy costs little.
    schedule.raysPerReceiver = 16;
    schedule.receiversPerPass = vertices;
    schedule.error = request.effort.error;
  } else if (request.effort.seconds) {
    schedule.raysPerReceiver = 64;
    schedule.receiversPerPass = std::min<double>(vertices, timedPassRays / schedule.raysPerReceiver);
    schedule.deadline =
        start + std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(
                    castShareOfTime * std::min(*request.effort.seconds, mostSeconds)));
  } else {
    schedule.raysPerReceiver = raysOfReceiver(request.effort.rays);
    schedule.receiversPerPass = static_cast<double>(vertices) * static_cast<double>(request.effort.rays) /
                                (schedule.raysPerReceiver * static_cast<double>(schedule.passes));
  }
  if (request.visibility == Visibility::Raster) countViews(request, vertices, schedule);
  return schedule;
}

std::uint32_t raysEach(const BakeRequest& request) {
  const std::uint64_t rays = request.effort.error || request.effort.seconds ? 1024 : request.effort.rays;
  return static_cast<std::uint32_t>(std::bit_floor(std::clamp<std::uint64_t>(rays, 16, 4096)));
}

}  // namespace prelight
