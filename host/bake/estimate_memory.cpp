#include "bake/estimate_memory.h"

#include <algorithm>

#include "plan/cast_orders.h"
#include "projectors/schedule.h"
#include "projectors/side_sums.h"

namespace prelight {

namespace {

constexpr std::uint64_t megabyte = std::uint64_t{1} << 20;
constexpr std::uint64_t programBytes = 80 * megabyte;  // the program, the device's compiler and libraries
constexpr std::uint64_t imageReaderBytes = 110 * megabyte;  // what is loaded where there are images
constexpr std::uint64_t blockBytes = 16 * megabyte;         // rays, hits and values on their way
constexpr std::uint64_t leastTransport = 16 * megabyte;
constexpr std::uint64_t treeBytesPerTriangle = 80;  // nodes and blocks, measured 65 to 95
constexpr double shareOfBacks = 0.5;  // of the receivers: how many backs are seen is not known yet

/// What bytes are counted by.
struct Sizes {
  std::uint64_t vertices, triangles, coefficients, receivers;
  bool bounces;
};

Sizes sizesOf(const PlanInput& input) {
  const auto order = static_cast<std::uint64_t>(castOrder(input.request));
  const Schedule schedule = makeSchedule(input.request, input.scene.vertexCount(), {});
  const std::uint64_t receivers = plannedRays(input.scene, input.request) / schedule.raysPerReceiver;
  return {input.scene.vertexCount(), input.scene.triangleCount(), order * order,
          std::min<std::uint64_t>(receivers, SideSums::mostRecords), input.bounces};
}

/// The parsed file and the compiled scene.
std::uint64_t sceneBytes(const Sizes& n) { return 72 * n.vertices + 40 * n.triangles; }

/// FitMesh, and where receivers go.
std::uint64_t surfaceBytes(const Sizes& n) {
  return 56 * n.vertices + 24 * n.triangles + 20 * n.triangles + (n.bounces ? 2 : 1) * 6 * n.triangles;
}

/// SideSums of the front and, with bounces, the back, with all records.
std::uint64_t sumBytes(const Sizes& n, bool bentNormal) {
  const std::uint64_t baseline = 4 * (1 + n.coefficients) * n.vertices;
  const std::uint64_t side = 24 * n.triangles + (4 * (1 + n.coefficients) + 9) * n.vertices;
  const std::uint64_t bent = bentNormal ? 24 * n.triangles + 12 * n.vertices : 0;
  const double records = double(n.receivers) * (n.bounces ? 1.0 + shareOfBacks : 1.0);
  return baseline + side * (n.bounces ? 2 : 1) + bent +
         sizeof(SampleRecord) * static_cast<std::uint64_t>(records);
}

/// What is in memory besides while the fit is solved or light bounces, whichever is more.
std::uint64_t solvingBytes(const Sizes& n) {
  const std::uint64_t equations = 108 * n.vertices, solver = 5 * 32 * n.vertices, part = 32 * n.vertices;
  const std::uint64_t fitted = 4 * (1 + n.coefficients) * n.vertices;
  const std::uint64_t fit = equations + solver + 6 * part + fitted;
  if (!n.bounces) return fit;
  return std::max(fit, 2 * equations + solver + 4 * part + 2 * fitted + 12 * n.coefficients * n.vertices);
}

std::uint64_t treeBytes(const Instancing& instancing) {
  return instancing.storedTriangles * treeBytesPerTriangle;
}

/// Whether the trees are kept after the cast, for rays of techniques.
bool keepsTrees(const BakeRequest& request) {
  return request.volume.size > 0 || request.chartTransfer.size > 0 || request.lightMap || request.radiosity;
}

std::uint64_t deviceSceneBytes(const PlanInput& input, const Instancing& instancing) {
  std::uint64_t texels = 0;
  for (const Image& image : input.scene.images) texels += 2 * image.rgba.size();
  return treeBytes(instancing) + instancing.storedTriangles * 16 + input.scene.triangleCount() * 13 +
         instancing.storedVertices * 24 + texels;
}

}  // namespace

void estimateMemory(const PlanInput& input, const Instancing& instancing, Plan& plan) {
  const Sizes n = sizesOf(input);
  plan.hostBytes += programBytes + sceneBytes(n) + (input.source.images.empty() ? 0 : imageReaderBytes);
  plan.deviceBytes += deviceSceneBytes(input, instancing);
  if (!input.request.castsReceivers()) return;
  const std::uint64_t reused = keepsTrees(input.request) ? 0 : treeBytes(instancing);
  plan.hostBytes +=
      surfaceBytes(n) + sumBytes(n, input.request.ao) + solvingBytes(n) - std::min(solvingBytes(n), reused);
  plan.deviceBytes += blockBytes;
  if (!n.bounces) return;
  plan.deviceBytes += 2 * 4 * PRELIGHT_PART_VALUES * n.vertices;
  const std::uint64_t wanted = plannedRays(input.scene, input.request) * senderBytes;
  const std::uint64_t others = plan.hostBytes + plan.deviceBytes, allowed = input.request.memory();
  plan.transportBytes = std::min(wanted, std::max(leastTransport, allowed - std::min(allowed, others)));
  plan.deviceBytes += plan.transportBytes;
}

}  // namespace prelight
