#include "cli/bake_options.h"

#include <fmt/format.h>

#include <limits>

#include "cli/values.h"

namespace prelight::cli {
namespace {

constexpr double minError = 1e-6;
constexpr double maxError = 1.0;
constexpr double minSeconds = 1e-3;
constexpr double maxSeconds = 1e7;
constexpr std::uint64_t minMemory = std::uint64_t{1} << 20;
constexpr std::uint64_t maxMemory = std::uint64_t{1} << 50;
constexpr int defaultShOrder = 3;
constexpr int defaultBounces = 1;

}  // namespace

void BakeOptions::addTo(DeviceOptions& device) const {
  device.cacheKernels = cacheKernels;
  device.dumpKernels = dumpKernels;
}

void useDefaultTechniques(BakeRequest& request) {
  request.ao = true;
  request.shOrder = defaultShOrder;
  if (request.bounces == 0) request.bounces = defaultBounces;
}

std::string techniqueText(const BakeRequest& request) {
  std::string text = request.ao ? "--ao" : "";
  if (request.shOrder > 0) text += fmt::format("{}--sh {}", text.empty() ? "" : " ", request.shOrder);
  if (request.bounces > 0) text += fmt::format("{}--bounces {}", text.empty() ? "" : " ", request.bounces);
  return text;
}

void addTechniqueOptions(CLI::App& app, BakeOptions& options) {
  BakeRequest& request = options.request;
  app.add_flag("--ao", request.ao, "ambient occlusion and bent normal");
  addWholeNumber(
      app, "--sh", {1, BakeRequest::maxShOrder},
      [&](std::uint64_t n) { request.shOrder = static_cast<int>(n); },
      fmt::format("spherical-harmonic transfer of this order, 1 to {} (order squared coefficients)",
                  BakeRequest::maxShOrder));
  addWholeNumber(
      app, "--bounces", {0, BakeRequest::maxBounces},
      [&](std::uint64_t n) { request.bounces = static_cast<int>(n); },
      fmt::format("diffuse bounces in the SH transfer, 0 to {}", BakeRequest::maxBounces));
}

void addEffortOptions(CLI::App& app, BakeOptions& options) {
  BakeRequest& request = options.request;
  CLI::Option* rays = addWholeNumber(
      app, "--rays", {1, BakeRequest::maxRays}, [&](std::uint64_t n) { request.rays = n; },
      fmt::format("rays a vertex, on average (default {})", request.rays));
  CLI::Option* error = addRealNumber(
      app, "--error", {minError, maxError}, [&](double value) { request.error = value; },
      "stop when the estimated standard error of AO is below this everywhere");
  CLI::Option* time = addRealNumber(
      app, "--time", {minSeconds, maxSeconds}, [&](double value) { request.seconds = value; },
      "stop after this many seconds of casting");
  rays->excludes(error)->excludes(time);
  error->excludes(time);
  addWholeNumber(
      app, "--seed", {0, std::numeric_limits<std::uint64_t>::max()},
      [&](std::uint64_t n) { request.seed = n; },
      "seed of the random numbers (default 0); the same seed gives the same bytes");
  addByteCount(
      app, "--max-memory", {minMemory, maxMemory}, [&](std::uint64_t n) { request.maxMemory = n; },
      "memory for the bake's own buffers, as 512M or 2G (default 2G)");
}

void addKernelOptions(CLI::App& app, BakeOptions& options) {
  app.add_flag_callback(
         "--cache-kernels", [&] { options.cacheKernels = true; },
         "keep compiled kernels between runs (default, except on PoCL, which does so itself)")
      ->excludes(app.add_flag_callback(
          "--no-cache-kernels", [&] { options.cacheKernels = false; }, "compile the kernels anew"));
  app.add_option("--dump-kernels", options.dumpKernels,
                 "write the kernels as they are compiled into this folder")
      ->type_name("DIR");
}

}  // namespace prelight::cli
