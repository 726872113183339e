#include "bake/baker.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bake/bounce.h"
#include "bake/side_cast.h"
#include "bvh/tracer.h"

namespace prelight {

namespace {

using Clock = std::chrono::steady_clock;

/// Adds the time since the last mark to the report under a name.
class StageClock {
 public:
  explicit StageClock(BakeReport& report) : report_(report), last_(Clock::now()) {}

  void mark(const std::string& stage) {
    const auto now = Clock::now();
    report_.stageSeconds.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  BakeReport& report_;
  Clock::time_point last_;
};

bool bounces(const BakeRequest& request, const Plan& plan) {
  return request.shOrder > 0 && request.bounces > 0 && plan.runs("bounces");
}

/// Rows of senders that the plan's memory and the device have room for.
std::uint32_t storedCapacity(const Plan& plan, const Device& device, std::uint32_t raysPerReceiver) {
  const std::uint64_t bytes = std::min(plan.transportBytes, device.info().maxAllocation);
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(
      bytes / (sizeof(device::Sender) * raysPerReceiver), 0xffffffffu / raysPerReceiver));
}

/// [slot][3][n], the transfer that leaves direct occlusion for the first bounce: the same in every channel.
std::vector<double> directTransfer(const SideCast& cast, const std::vector<double>& fitted,
                                   std::size_t slots) {
  const std::size_t columns = cast.baseline().columns(), n = columns - 1;
  std::vector<double> transfer(slots * 3 * n);
  for (std::size_t s = 0; s < slots; ++s)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < n; ++i)
        transfer[(s * 3 + c) * n + i] = cast.baseline().row(s)[1 + i] + fitted[s * columns + 1 + i];
  return transfer;
}

/// The backs that rays have seen, cast like fronts.
struct BackCast {
  SideCast cast;
  std::vector<std::uint8_t> seen;  ///< [triangle]
};

constexpr int maxBackRounds = 4;  // backs seen from backs, and so on; what lies deeper reflects nothing

/// Casts from the backs that rays have met, and from those that these meet. nullptr when there are none.
std::unique_ptr<BackCast> castBacks(const CompiledScene& scene, const FitMesh& mesh, Caster& caster,
                                    const Schedule& schedule, const SideCast& front, std::uint32_t capacity,
                                    Progress& progress, BakeReport& report) {
  std::unique_ptr<BackCast> back;
  for (int round = 0; round < maxBackRounds; ++round) {
    std::vector<std::uint8_t> fresh = caster.backMarks();
    for (std::size_t t = 0; back && t < fresh.size(); ++t) fresh[t] = fresh[t] && !back->seen[t];
    if (std::count(fresh.begin(), fresh.end(), 1) == 0) break;
    if (!back)
      back.reset(new BackCast{SideCast(scene, mesh, caster, schedule, Side::Back),
                              std::vector<std::uint8_t>(scene.triangleCount(), 0)});
    for (std::size_t t = 0; t < fresh.size(); ++t) back->seen[t] |= fresh[t];
    back->cast.active() = std::move(fresh);
    back->cast.run(progress, front.storedCount(), capacity - front.storedCount());
  }
  report.notes.push_back(
      back ? fmt::format("back faces: {} triangles are seen from behind and reflect there too",
                         std::count(back->seen.begin(), back->seen.end(), 1))
           : "back faces: skipped, no ray meets one that reflects");
  return back;
}

/// Direct transfer of the backs; 0 where none was cast.
std::vector<double> backTransfer(const BackCast& back, const FitMesh& mesh) {
  std::vector<double> transfer = directTransfer(back.cast, back.cast.solve(), mesh.slotCount());
  std::vector<std::uint8_t> covered(mesh.slotCount(), 0);
  for (std::size_t t = 0; t < back.seen.size(); ++t)
    for (const std::uint32_t slot : mesh.triangles[t]) covered[slot] |= back.seen[t];
  const std::size_t row = transfer.size() / mesh.slotCount();
  for (std::size_t slot = 0; slot < covered.size(); ++slot)
    if (!covered[slot]) std::fill_n(transfer.begin() + static_cast<std::ptrdiff_t>(slot * row), row, 0.0);
  return transfer;
}

/// Sum of direct transfer and all bounces of the front, [slot][3][n].
std::vector<double> bounceAll(const CompiledScene& scene, const FitMesh& mesh, Caster& caster, int shOrder,
                              int count, const SideCast& front, const std::vector<double>& fitted,
                              const BackCast* back, Progress& progress, BakeReport& report) {
  BounceSide frontSide{&front, directTransfer(front, fitted, mesh.slotCount())};
  BounceSide backSide;
  if (back != nullptr) backSide = {&back->cast, backTransfer(*back, mesh)};
  std::vector<double> total = frontSide.transfer;
  for (int b = 0; b < count; ++b) {
    bounceOnce(scene, mesh, caster, shOrder, frontSide, back != nullptr ? &backSide : nullptr, progress);
    double most = 0.0;
    for (std::size_t i = 0; i < total.size(); ++i) {
      total[i] += frontSide.transfer[i];
      most = std::max(most, std::abs(frontSide.transfer[i]));
    }
    progress.report("bounce", double(b + 1) / count);
    if (most < 1e-6 && b + 1 < count) {
      report.notes.push_back(fmt::format("bounces after {}: skipped, nothing is left to reflect", b + 1));
      break;
    }
  }
  return total;
}

float finiteOr(double value, float fallback) {
  const auto f = static_cast<float>(value);
  return std::isfinite(f) ? f : fallback;
}

/// [vertex], unit. The mean of directions above the surface is above it too, whatever the fit overshoots.
std::vector<glm::vec3> bentNormals(const SideCast& front, const FitMesh& mesh, const CompiledScene& scene) {
  const std::vector<double> fitted = front.solveBentNormal();
  std::vector<glm::vec3> normals;
  normals.reserve(scene.vertexCount());
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const std::size_t slot = mesh.slotOfVertex[v];
    const glm::dvec3 n = glm::normalize(glm::dvec3(scene.normals[v]));
    glm::dvec3 bent = n + glm::dvec3(fitted[3 * slot], fitted[3 * slot + 1], fitted[3 * slot + 2]);
    bent -= std::min(0.0, glm::dot(bent, n)) * n;
    const double length = glm::length(bent);
    // Where nothing is open there is no mean direction; the normal is as good as any.
    normals.push_back(length > 1e-5 ? glm::vec3(bent / length) : glm::vec3(n));
  }
  return normals;
}

void packAo(const FitMesh& mesh, const SideCast& front, const std::vector<double>& fitted,
            const CompiledScene& scene, Bake& bake) {
  const std::size_t columns = front.baseline().columns();
  bake.bentNormals = bentNormals(front, mesh, scene);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    bake.ao.push_back(finiteOr(std::clamp(1.0 + fitted[mesh.slotOfVertex[v] * columns], 0.0, 1.0), 1.0f));
}

void packSh(const FitMesh& mesh, const std::vector<double>& transfer, const CompiledScene& scene,
            int channels, int shOrder, Bake& bake) {
  const auto n = static_cast<std::size_t>(shOrder * shOrder);
  bake.sh = ShTransfer{shOrder, channels, 0, {}};
  bake.sh->coefficients.reserve(scene.vertexCount() * static_cast<std::size_t>(channels) * n);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const std::size_t row = mesh.slotOfVertex[v] * 3 * n;
    for (std::size_t i = 0; i < static_cast<std::size_t>(channels) * n; ++i)
      bake.sh->coefficients.push_back(finiteOr(transfer[row + i], 0.0f));
  }
}

}  // namespace

Bake bakeScene(const CompiledScene& scene, const BakeRequest& request, const Plan& plan, const Device& device,
               Progress& progress, BakeReport& report) {
  if (scene.triangleCount() == 0)
    throw InputError("scene", "there is no triangle to bake",
                     "bake needs a mesh with at least one triangle of non-zero area");
  const auto start = Clock::now();
  StageClock clock(report);
  const bool withBounces = bounces(request, plan);
  const FitMesh mesh = makeFitMesh(scene);
  const Schedule schedule = makeSchedule(request, mesh.slotCount(), start);
  Tracer tracer(scene, device);
  const std::uint32_t capacity = withBounces ? storedCapacity(plan, device, schedule.raysPerReceiver) : 0;
  Caster caster(scene, tracer, {request.shOrder, schedule.raysPerReceiver, capacity});
  report.bytesBvh = tracer.bvhBytes();
  clock.mark("prepare");

  SideCast front(scene, mesh, caster, schedule, Side::Front);
  front.run(progress, 0, capacity);
  std::unique_ptr<BackCast> back;
  if (withBounces) back = castBacks(scene, mesh, caster, schedule, front, capacity, progress, report);
  clock.mark("cast");

  const std::vector<double> fitted = front.solve();
  const ErrorEstimate error = front.estimateError();
  clock.mark("fit");

  Bake bake;
  if (request.ao) packAo(mesh, front, fitted, scene, bake);
  if (request.shOrder > 0) {
    const auto transfer = withBounces ? bounceAll(scene, mesh, caster, request.shOrder, request.bounces,
                                                  front, fitted, back.get(), progress, report)
                                      : directTransfer(front, fitted, mesh.slotCount());
    packSh(mesh, transfer, scene, withBounces ? 3 : 1, request.shOrder, bake);
    bake.sh->bounces = withBounces ? request.bounces : 0;
    clock.mark("bounce");
  }

  report.rays = front.rays() + (back ? back->cast.rays() : 0);
  report.receivers = front.receivers() + (back ? back->cast.receivers() : 0);
  report.aoErrorRms = error.rms;
  report.aoErrorMax = error.max;
  if (!request.error && !request.seconds)
    report.skippedRayFraction =
        std::max(0.0, 1.0 - double(front.receivers()) / (schedule.receiversPerPass * schedule.passes));
  bake.info = {std::string("Prelight ") + PRELIGHT_VERSION,
               request.seed,
               report.rays,
               error.rms,
               withBounces ? request.bounces : 0,
               plan.toJson(),
               device.info().name,
               std::chrono::duration<double>(Clock::now() - start).count()};
  return bake;
}

}  // namespace prelight
