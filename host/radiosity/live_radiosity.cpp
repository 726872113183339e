#include "radiosity/live_radiosity.h"

#include <utility>

#include "gpu/tracer.h"
#include "prelight/error.h"
#include "radiosity/radiosity_bake.h"
#include "receivers/fit_mesh.h"

namespace prelight {

namespace {

constexpr double firstSweeps = 2.0;       ///< before light is shown for the first time
constexpr double shareOfTolerance = 0.1;  ///< solutions that start elsewhere then agree to the tolerance

RadiosityOptions optionsOf(const CompiledScene& scene, const BakeRequest& request) {
  RadiosityOptions options = radiosityOptions(scene, request);
  options.tolerance *= shareOfTolerance;
  return options;
}

}  // namespace

struct LiveRadiosity::Solution {
  Device device;
  Tracer tracer;
  FitMesh mesh;
  Radiosity radiosity;

  Solution(const CompiledScene& scene, const BakeRequest& request, const DeviceOptions& options)
      : device(Device::open(options)),
        tracer(scene, device),
        mesh(makeFitMesh(scene)),
        radiosity(scene, tracer, optionsOf(scene, request)) {}
};

/// Ends work when nobody wants it any more.
class LiveRadiosity::Watch final : public Progress {
 public:
  enum class Ends { WithTheThread, WithNewerLights };

  Watch(const LiveRadiosity& owner, const std::stop_token& stop, Ends ends)
      : owner_(owner), stop_(stop), ends_(ends) {}

  bool stopRequested() const override {
    return stop_.stop_requested() || (ends_ == Ends::WithNewerLights && owner_.hasNewer());
  }

 private:
  const LiveRadiosity& owner_;
  const std::stop_token& stop_;
  Ends ends_;
};

LiveRadiosity::LiveRadiosity(const CompiledScene& scene, const BakeRequest& request,
                             const DeviceOptions& device)
    : scene_(scene), request_(request), device_(device) {
  optionsOf(scene, request);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

LiveRadiosity::~LiveRadiosity() {
  {
    const std::lock_guard lock(guard_);
    thread_.request_stop();
  }
  changed_.notify_all();
}

void LiveRadiosity::setLights(const RadiosityLights& lights) {
  {
    const std::lock_guard lock(guard_);
    newest_ = lights;
  }
  changed_.notify_all();
}

bool LiveRadiosity::isBusy() const {
  const std::lock_guard lock(guard_);
  return !failure_ && (busy_ || newest_.has_value());
}

std::optional<std::vector<glm::vec3>> LiveRadiosity::take() {
  const std::lock_guard lock(guard_);
  if (failure_) std::rethrow_exception(failure_);
  return std::exchange(found_, std::nullopt);
}

void LiveRadiosity::wait() const {
  std::unique_lock lock(guard_);
  changed_.wait(lock, [&] { return failure_ || !(busy_ || newest_.has_value()); });
}

std::uint64_t LiveRadiosity::formFactorRays() const {
  const std::lock_guard lock(guard_);
  return formFactorRays_;
}

bool LiveRadiosity::hasNewer() const {
  const std::lock_guard lock(guard_);
  return newest_.has_value();
}

void LiveRadiosity::publish() {
  std::vector<glm::vec3> irradiance = solution_->radiosity.irradianceOfVertices(solution_->mesh);
  const std::lock_guard lock(guard_);
  found_ = std::move(irradiance);
  formFactorRays_ = solution_->radiosity.report().castRays;
}

void LiveRadiosity::follow(const RadiosityLights& lights, const std::stop_token& stop) {
  Watch always(*this, stop, Watch::Ends::WithTheThread);
  if (solution_ == nullptr) {
    auto solution = std::make_unique<Solution>(scene_, request_, device_);
    solution->radiosity.cast(always);
    solution_ = std::move(solution);
  }
  Radiosity& radiosity = solution_->radiosity;
  radiosity.setLights(lights, always);
  // Not given up for newer lights: a lamp that is dragged all the time would never show its light.
  const bool converged = radiosity.solve(always, firstSweeps).converged;
  publish();
  if (converged) return;
  Watch newer(*this, stop, Watch::Ends::WithNewerLights);
  radiosity.solve(newer);
  publish();
}

void LiveRadiosity::run(const std::stop_token& stop) {
  std::unique_lock lock(guard_);
  while (true) {
    changed_.wait(lock, [&] { return stop.stop_requested() || newest_.has_value(); });
    if (stop.stop_requested()) return;
    const RadiosityLights lights = *std::exchange(newest_, std::nullopt);
    busy_ = true;
    lock.unlock();
    std::exception_ptr failure;
    try {
      follow(lights, stop);
    } catch (const Interrupted&) {
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    failure_ = failure;
    changed_.notify_all();
    if (failure_) return;
  }
}

}  // namespace prelight
