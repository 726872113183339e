#include "bake/estimate_memory.h"

#include <algorithm>
#include <array>

#include "cast/light_column.h"
#include "cast/schedule.h"
#include "cast/stored_transport.h"
#include "fit/sample_records.h"
#include "plan/cast_orders.h"
#include "plan/file_use.h"
#include "plan/tree_use.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

constexpr std::uint64_t megabyte = std::uint64_t{1} << 20;
constexpr std::uint64_t programBytes = 82 * megabyte;  // the program, the device's compiler and libraries
// Libraries that are loaded where the scene has images.
constexpr std::uint64_t imageReaderBytes = 110 * megabyte;
constexpr std::uint64_t blockBytes = 16 * megabyte;     // rays, hits and values of the blocks in flight
constexpr std::uint64_t specularBytes = 24 * megabyte;  // rays that go on from mirrors and glass
constexpr std::uint64_t walkBytes = 24 * megabyte;      // rays that walk within bodies
constexpr std::uint64_t lightBytes = 2200;              // a light in the file and in the scene
constexpr std::uint64_t leastInMemory = 16 * megabyte;  // least memory for data that may lie in a file
constexpr std::uint64_t blockRays = 1 << 17;            // rays per block of receivers
// 1/20 of the estimate is added for freed blocks that the allocator keeps
constexpr std::uint64_t slack = 20;
constexpr double shareOfBacks = 0.5;  // back sides seen per receiver; the true share is not known yet

// Default memory bound besides the bytes of the results: 290 MB and 400 bytes per triangle, which with the
// error of the estimates is 300 MB.
constexpr std::uint64_t usualBytes = 290'000'000;
constexpr std::uint64_t usualBytesPerTriangle = 400;

/// Counts of the scene and the request that byte estimates are made from.
struct Sizes {
  std::uint64_t vertices, triangles, coefficients, groups, receivers;
  bool bounces, ao, specular, subsurface;

  std::uint64_t columns() const { return 1 + (specular ? 4 : 1) * coefficients + 3 * groups; }
  bool backs() const { return bounces || subsurface; }
  std::uint64_t sides() const { return backs() ? 2 : 1; }
};

/// Returns the counts of lights whose transfer is kept.
LightCounts lightsOf(const PlanInput& input) {
  return input.request.lightGroups ? countLights(input.scene, input.request.lightGroups.named)
                                   : LightCounts{};
}

Sizes sizesOf(const PlanInput& input) {
  const auto order = static_cast<std::uint64_t>(castOrder(input.request));
  const Schedule schedule = makeSchedule(input.request, input.scene.vertexCount(), {});
  const std::uint64_t receivers = plannedRays(input.scene, input.request) / schedule.raysPerReceiver;
  return {input.scene.vertexCount(),
          input.scene.triangleCount(),
          order * order,
          lightsOf(input).groups,
          std::min<std::uint64_t>(receivers, SampleRecords::most),
          input.bounces,
          input.request.ao,
          input.request.specular,
          input.request.subsurface};
}

/// Bytes of a block's shadow rays and of what is summed up from them.
std::uint64_t groupBytes(const PlanInput& input, const Sizes& n) {
  if (n.groups == 0) return 0;
  const std::uint64_t most =
      blockRays / makeSchedule(input.request, input.scene.vertexCount(), {}).raysPerReceiver;
  return lightBlockBytesOf(lightsOf(input).rays, n.groups, 1, most) + 12 * n.groups * n.vertices;
}

/// Bytes of the compiled scene, and of its file unless that lies in a temporary file.
std::uint64_t sceneBytes(const Sizes& n, const BakeRequest& request) {
  const std::uint64_t file = 24 * n.vertices + 12 * n.triangles;
  return 32 * n.vertices + 17 * n.triangles + (fileWaits(request, file) ? 0 : file);
}

/// Bytes of FitMesh, of the triangles' receivers, and of the values of unoccluded receivers.
std::uint64_t surfaceBytes(const Sizes& n) {
  return (56 + 4 * n.columns()) * n.vertices + (24 + 20 + 10 * n.sides()) * n.triangles;
}

/// Bytes of the sums of one side (front or back) while receivers add to them.
std::uint64_t sumBytes(const Sizes& n, bool bentNormal) {
  return 24 * n.triangles + 4 * n.columns() * n.vertices +
         (bentNormal ? 24 * n.triangles + 12 * n.vertices : 0);
}

/// Bytes of the part of the sums that is kept until the end.
std::uint64_t keptSumBytes(const Sizes& n) { return 13 * n.vertices * n.sides(); }

/// Bytes of accessibility that later techniques read, and of its results.
std::uint64_t accessibilityBytes(const Sizes& n) { return (8 + (n.ao ? 16 : 0)) * n.vertices; }

std::uint64_t recordBytes(const Sizes& n) {
  const double receivers = double(n.receivers) * (n.backs() ? 1.0 + shareOfBacks : 1.0);
  return sizeof(SampleRecord) * static_cast<std::uint64_t>(receivers);
}

/// Bytes of the textures: on the host as they were read, with the albedos that the compiled scene holds; on
/// the device, where a texel takes twice as much; and temporary copies on the way there.
struct TextureBytes {
  std::uint64_t onHost, onDevice, onTheirWay;
};

TextureBytes textureBytes(const PlanInput& input) {
  std::uint64_t read = 0, albedo = 0, largest = 0;
  for (const Image& image : input.source.images) read += image.rgba.size();
  for (const Image& image : input.scene.images) {
    albedo += image.rgba.size();
    largest = std::max<std::uint64_t>(largest, image.rgba.size());
  }
  // Light maps need all textures on the device, besides the albedos that all rays need.
  const std::uint64_t lit = input.request.lightMap ? 2 * read : 0;
  // The array that textures are joined in grows from image to image.
  return {read + albedo, 2 * albedo + lit, std::max(2 * (2 * albedo - largest), 2 * lit)};
}

std::uint64_t treeBytes(const Instancing& instancing) {
  return instancing.storedTriangles * treeBytesPerTriangle;
}

/// Bytes that a stage takes beyond what lives throughout the bake.
struct Stage {
  std::uint64_t host, device;

  std::uint64_t sum() const { return host + device; }
};

constexpr std::uint64_t equationBytes = 108, fourColumns = 16;  // bytes per vertex

/// Returns the stages: upload of textures, cast, error estimation, bounces. `parks`: sums of the waiting side
/// lie in a file.
std::array<Stage, 4> stagesOf(const Sizes& n, const PlanInput& input, const Instancing& instancing,
                              bool parks) {
  const std::uint64_t front = sumBytes(n, n.ao), back = n.backs() ? sumBytes(n, false) : 0;
  const std::uint64_t kept = keepsTrees(input.request) ? treeBytes(instancing) : 0;
  const std::uint64_t waiting = parks ? 0 : front + back;
  const std::uint64_t fitted = 4 * n.columns() * n.vertices;
  const Stage cast{parks ? std::max(front, back) : front + back, treeBytes(instancing)};
  // Deviations of eight groups, five vectors for each column that is solved at once, and the solver's own.
  const std::uint64_t atOnce = parks ? fourColumns : 2 * fourColumns;
  const Stage errors{waiting + fitted + (equationBytes + 4 * fourColumns + 10 * atOnce) * n.vertices, kept};
  const Stage textures{textureBytes(input).onTheirWay, treeBytes(instancing)};
  if (!n.bounces) return {textures, cast, errors, {}};
  const std::uint64_t part = 4 * partValuesOf(parks);
  // The solver takes eight or twelve columns at once.
  const std::uint64_t solverBytes = 5 * (parks ? 2 : 3) * fourColumns;
  const Stage bounce{waiting + 2 * fitted +
                         (equationBytes + solverBytes + part + 12 * (n.coefficients + n.groups)) * n.vertices,
                     kept + 2 * part * n.vertices};
  return {textures, cast, errors, bounce};
}

/// Returns the largest device bytes of any stage, and the host bytes that complete the largest sum of both.
Stage largest(const std::array<Stage, 4>& stages) {
  std::uint64_t device = 0, sum = 0;
  for (const Stage& stage : stages) {
    device = std::max(device, stage.device);
    sum = std::max(sum, stage.sum());
  }
  return {sum - device, device};
}

/// Bytes of the scene on the device. A mesh is stored once, however many instances it has; only the normal
/// and the mark that tell sides apart are stored per instance.
std::uint64_t deviceSceneBytes(const PlanInput& input, const Instancing& instancing) {
  const BakeRequest& request = input.request;
  const bool sides = input.bounces || request.occluders.wanted || keepsTrees(request);
  return instancing.storedTriangles * 16 + (sides ? input.scene.triangleCount() * 13 : 0) +
         instancing.storedVertices * 24 + textureBytes(input).onDevice;
}

/// Returns the memory bound: the requested one or the default.
std::uint64_t boundOf(const PlanInput& input, const Sizes& n) {
  const std::uint64_t written =
      (24 + 12 + 4 * (n.coefficients + n.groups) * (input.colored() ? 3 : 1) * (n.subsurface ? 2 : 1)) *
          n.vertices +
      12 * n.triangles;
  return input.request.maxMemory.value_or(usualBytes + usualBytesPerTriangle * n.triangles + written);
}

/// Gives the remaining memory to data that may lie in files: first to the records, which are read most often.
void shareRest(const PlanInput& input, const Sizes& n, std::uint64_t bound, Plan& plan) {
  const std::uint64_t others = plan.hostBytes + plan.deviceBytes;
  std::uint64_t left = bound - std::min(bound, others);
  const auto take = [&](std::uint64_t wanted) {
    const std::uint64_t taken = std::min(wanted, std::max(leastInMemory, left));
    left -= std::min(left, taken);
    return taken;
  };
  plan.recordBytes = take(recordBytes(n));
  plan.hostBytes += plan.recordBytes;
  if (!n.bounces) return;
  plan.transportBytes = take(plannedRays(input.scene, input.request) * senderBytes);
  plan.deviceBytes += plan.transportBytes;
}

}  // namespace

void estimateMemory(const PlanInput& input, const Instancing& instancing, Plan& plan) {
  const Sizes n = sizesOf(input);
  const std::uint64_t ofTechniques = plan.hostBytes + plan.deviceBytes;
  const TextureBytes textures = textureBytes(input);
  plan.hostBytes += programBytes + sceneBytes(n, input.request) + textures.onHost +
                    lightBytes * input.source.lights.size() +
                    (input.source.images.empty() ? 0 : imageReaderBytes);
  plan.deviceBytes += deviceSceneBytes(input, instancing);
  if (!input.request.castsReceivers()) {
    plan.deviceBytes += treeBytes(instancing);
    plan.hostBytes +=
        // Techniques take their memory after the upload.
        textures.onTheirWay - std::min(textures.onTheirWay, ofTechniques);
    return;
  }
  plan.hostBytes += surfaceBytes(n) + keptSumBytes(n) + accessibilityBytes(n);
  const bool walks = (n.specular || (n.subsurface && n.bounces)) && anyHasInside(input.scene);
  plan.deviceBytes += groupBytes(input, n);
  plan.deviceBytes += blockBytes + (n.specular || walks ? specularBytes : 0) + (walks ? walkBytes : 0);
  const std::uint64_t bound =
      (boundOf(input, n) - std::min(boundOf(input, n), programBytes)) * slack / (slack + 1) + programBytes;
  const std::uint64_t inMemory = plan.hostBytes + plan.deviceBytes + recordBytes(n) +
                                 largest(stagesOf(n, input, instancing, false)).sum();
  plan.parks = inMemory > bound;
  const Stage most = largest(stagesOf(n, input, instancing, plan.parks));
  plan.hostBytes += most.host;
  plan.deviceBytes += most.device;
  shareRest(input, n, bound, plan);
  plan.hostBytes += (plan.hostBytes + plan.deviceBytes - programBytes) / slack;
}

}  // namespace prelight
