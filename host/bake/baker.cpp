#include "bake/baker.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bake/bounce.h"
#include "bake/scene_cast.h"
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

std::string backNote(const SceneCast& cast) {
  return cast.back() != nullptr
             ? fmt::format("back faces: {} triangles are seen from behind and reflect there too",
                           std::count(cast.backSeen().begin(), cast.backSeen().end(), 1))
             : "back faces: skipped, no ray meets one that reflects";
}

/// Direct transfer of the backs; 0 where none was cast.
std::vector<double> backTransfer(const SceneCast& cast, const FitMesh& mesh) {
  std::vector<double> transfer = directTransfer(*cast.back(), cast.back()->solve(), mesh.slotCount());
  std::vector<std::uint8_t> covered(mesh.slotCount(), 0);
  for (std::size_t t = 0; t < cast.backSeen().size(); ++t)
    for (const std::uint32_t slot : mesh.triangles[t]) covered[slot] |= cast.backSeen()[t];
  const std::size_t row = transfer.size() / mesh.slotCount();
  for (std::size_t slot = 0; slot < covered.size(); ++slot)
    if (!covered[slot]) std::fill_n(transfer.begin() + static_cast<std::ptrdiff_t>(slot * row), row, 0.0);
  return transfer;
}

/// Sum of direct transfer and all bounces of the front, [slot][3][n].
std::vector<double> bounceAll(const CompiledScene& scene, const FitMesh& mesh, Caster& caster, int shOrder,
                              int count, const SceneCast& cast, const std::vector<double>& fitted,
                              Progress& progress, BakeReport& report) {
  BounceSide frontSide{&cast.front(), directTransfer(cast.front(), fitted, mesh.slotCount())};
  BounceSide backSide;
  if (cast.back() != nullptr) backSide = {cast.back(), backTransfer(cast, mesh)};
  std::vector<double> total = frontSide.transfer;
  for (int b = 0; b < count; ++b) {
    bounceOnce(scene, mesh, caster, shOrder, frontSide, backSide.cast != nullptr ? &backSide : nullptr,
               progress);
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
  bake.sh = HarmonicTransfer{shOrder, channels, 0, {}};
  bake.sh->coefficients.reserve(scene.vertexCount() * static_cast<std::size_t>(channels) * n);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const std::size_t row = mesh.slotOfVertex[v] * 3 * n;
    for (std::size_t i = 0; i < static_cast<std::size_t>(channels) * n; ++i)
      bake.sh->coefficients.push_back(finiteOr(transfer[row + i], 0.0f));
  }
}

/// The stages of a bake after its parts are made.
class BakeRunner {
 public:
  BakeRunner(const CompiledScene& scene, const BakeRequest& request, const FitMesh& mesh, Caster& caster,
             SceneCast& cast, Progress& progress, BakeReport& report, StageClock& clock)
      : scene_(scene),
        request_(request),
        mesh_(mesh),
        caster_(caster),
        cast_(cast),
        progress_(progress),
        report_(report),
        clock_(clock) {}

  /// Everything but the info.
  Bake run(bool withBounces) {
    cast_.run(progress_);
    if (withBounces) report_.notes.push_back(backNote(cast_));
    clock_.mark("cast");
    const std::vector<double> fitted = cast_.front().solve();
    const ErrorEstimate error = cast_.front().estimateError();
    report_.aoErrorRms = error.rms;
    report_.aoErrorMax = error.max;
    clock_.mark("fit");
    Bake bake;
    if (request_.ao) packAo(mesh_, cast_.front(), fitted, scene_, bake);
    if (request_.shOrder > 0) makeSh(fitted, withBounces, bake);
    return bake;
  }

 private:
  void makeSh(const std::vector<double>& fitted, bool withBounces, Bake& bake) {
    const auto transfer = withBounces ? bounceAll(scene_, mesh_, caster_, request_.shOrder, request_.bounces,
                                                  cast_, fitted, progress_, report_)
                                      : directTransfer(cast_.front(), fitted, mesh_.slotCount());
    packSh(mesh_, transfer, scene_, withBounces ? 3 : 1, request_.shOrder, bake);
    bake.sh->bounces = withBounces ? request_.bounces : 0;
    clock_.mark("bounce");
  }

  const CompiledScene& scene_;
  const BakeRequest& request_;
  const FitMesh& mesh_;
  Caster& caster_;
  SceneCast& cast_;
  Progress& progress_;
  BakeReport& report_;
  StageClock& clock_;
};

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void saveTo(BakeCheckpoint& checkpoint, const SceneCast& cast, Clock::time_point start) {
  if (cast.receivers() == 0) return;
  StateWriter state;
  state.value(secondsSince(start));
  cast.save(state);
  checkpoint.save(state.payload());
}

}  // namespace

Bake bakeScene(const CompiledScene& scene, const BakeRequest& request, const Plan& plan, const Device& device,
               Progress& progress, BakeReport& report, BakeCheckpoint* checkpoint) {
  if (scene.triangleCount() == 0)
    throw InputError("scene", "there is no triangle to bake",
                     "bake needs a mesh with at least one triangle of non-zero area");
  std::optional<StateReader> saved = checkpoint != nullptr ? checkpoint->load() : std::nullopt;
  double earlierSeconds = 0.0;
  if (saved) saved->value(earlierSeconds);
  const auto start = Clock::now() - std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(earlierSeconds));
  StageClock clock(report);
  const bool withBounces = bounces(request, plan);
  const FitMesh mesh = makeFitMesh(scene);
  const Schedule schedule = makeSchedule(request, mesh.slotCount(), start);
  Tracer tracer(scene, device);
  const std::uint32_t capacity = withBounces ? storedCapacity(plan, device, schedule.raysPerReceiver) : 0;
  Caster caster(scene, tracer, {request.shOrder, schedule.raysPerReceiver, capacity});
  report.bytesBvh = tracer.bvhBytes();
  SceneCast cast(scene, mesh, caster, schedule, capacity);
  if (saved) cast.load(*saved);
  saved.reset();
  clock.mark("prepare");

  Bake bake;
  try {
    bake = BakeRunner(scene, request, mesh, caster, cast, progress, report, clock).run(withBounces);
  } catch (const Interrupted&) {
    if (checkpoint != nullptr) saveTo(*checkpoint, cast, start);
    throw;
  }
  report.rays = cast.rays();
  report.receivers = cast.receivers();
  if (!request.error && !request.seconds)
    report.skippedRayFraction =
        std::max(0.0, 1.0 - double(cast.front().receivers()) / (schedule.receiversPerPass * schedule.passes));
  bake.info = {
      std::string("Prelight ") + PRELIGHT_VERSION, request.seed,  report.rays,        report.aoErrorRms,
      withBounces ? request.bounces : 0,           plan.toJson(), device.info().name, secondsSince(start)};
  return bake;
}

}  // namespace prelight
