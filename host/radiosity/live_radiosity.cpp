#include "radiosity/live_radiosity.h"

#include <fmt/format.h>

#include <utility>

#include "gpu/tracer.h"
#include "prelight/error.h"
#include "radiosity/radiosity_bake.h"
#include "receivers/fit_mesh.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

constexpr double firstSweeps = 2.0;  ///< before light is shown for the first time
/// Solutions with different initial values then agree to within the tolerance.
constexpr double shareOfTolerance = 0.1;

RadiosityOptions optionsOf(const CompiledScene& scene, const BakeRequest& request) {
  RadiosityOptions options = radiosityOptions(scene, request);
  options.tolerance *= shareOfTolerance;
  return options;
}

bool sameLights(const RadiosityLights& a, const RadiosityLights& b) {
  return a.punctual == b.punctual && a.sky == b.sky && a.skyRotation == b.skyRotation &&
         a.emitters == b.emitters;
}

}  // namespace

struct LiveRadiosity::Solution {
  /// Solution of a group of lights.
  struct Group {
    std::optional<RadiosityLights> lights;  ///< none: nothing has been found yet
    bool converged = false;
    std::vector<glm::vec4> irradiance;  ///< [element], initial value of the next solution
    VertexLight light;

    bool isOf(const RadiosityLights& asked) const {
      return lights && converged && sameLights(*lights, asked);
    }
  };

  Device device;
  Tracer tracer;
  FitMesh mesh;
  Radiosity radiosity;
  std::vector<Group> groups;

  Solution(const CompiledScene& scene, const BakeRequest& request, const DeviceOptions& options)
      : device(Device::open(options)),
        tracer(scene, device),
        mesh(makeFitMesh(scene)),
        radiosity(scene, tracer, optionsOf(scene, request)) {}
};

/// Ends work whose result is no longer needed.
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

void LiveRadiosity::setGroups(std::vector<RadiosityLights> groups) {
  {
    const std::lock_guard lock(guard_);
    newest_ = std::move(groups);
  }
  changed_.notify_all();
}

bool LiveRadiosity::isBusy() const {
  const std::lock_guard lock(guard_);
  return !failure_ && (busy_ || newest_.has_value());
}

std::optional<std::vector<VertexLight>> LiveRadiosity::takeGroups() {
  const std::lock_guard lock(guard_);
  if (failure_) std::rethrow_exception(failure_);
  return std::exchange(found_, std::nullopt);
}

std::optional<std::vector<glm::vec3>> LiveRadiosity::take() {
  const auto groups = takeGroups();
  if (!groups) return std::nullopt;
  return irradianceOf(*groups, std::vector<glm::vec3>(groups->size(), glm::vec3(1.0f)));
}

void LiveRadiosity::wait() const {
  std::unique_lock lock(guard_);
  changed_.wait(lock, [&] { return failure_ || !(busy_ || newest_.has_value()); });
}

std::uint64_t LiveRadiosity::formFactorRays() const {
  const std::lock_guard lock(guard_);
  return formFactorRays_;
}

std::uint64_t LiveRadiosity::solves() const {
  const std::lock_guard lock(guard_);
  return solves_;
}

bool LiveRadiosity::hasNewer() const {
  const std::lock_guard lock(guard_);
  return newest_.has_value();
}

void LiveRadiosity::publish() {
  std::vector<VertexLight> lights;
  for (const Solution::Group& group : solution_->groups) lights.push_back(group.light);
  const std::lock_guard lock(guard_);
  found_ = std::move(lights);
  formFactorRays_ = solution_->radiosity.report().castRays;
}

/// Solves for a group, starting from its last solution.
void LiveRadiosity::lightGroup(std::size_t index, const RadiosityLights& lights, std::optional<double> sweeps,
                               Progress& progress) {
  Radiosity& radiosity = solution_->radiosity;
  Solution::Group& group = solution_->groups[index];
  radiosity.setLights(lights, progress);
  if (!group.irradiance.empty()) radiosity.startFrom(group.irradiance);
  keepSolution(index, lights, radiosity.solve(progress, sweeps).converged);
}

void LiveRadiosity::keepSolution(std::size_t index, const RadiosityLights& lights, bool converged) {
  Solution::Group& group = solution_->groups[index];
  group.lights = lights;
  group.converged = converged;
  group.irradiance = solution_->radiosity.irradianceOfElements();
  group.light = solution_->radiosity.lightOfVertices(solution_->mesh, Progress());
  const std::lock_guard lock(guard_);
  ++solves_;
}

void LiveRadiosity::follow(const std::vector<RadiosityLights>& asked, const std::stop_token& stop) {
  Watch always(*this, stop, Watch::Ends::WithTheThread);
  if (solution_ == nullptr) {
    auto solution = std::make_unique<Solution>(scene_, request_, device_);
    solution->radiosity.cast(always);
    solution_ = std::move(solution);
  }
  std::vector<Solution::Group>& groups = solution_->groups;
  if (groups.size() != asked.size()) groups.assign(asked.size(), {});
  std::vector<std::size_t> changed;
  for (std::size_t g = 0; g < asked.size(); ++g)
    if (!groups[g].isOf(asked[g])) changed.push_back(g);
  // This work is not abandoned for newer lights, because a lamp that is dragged continuously would never show
  // its light. Many groups only change at the start.
  const bool one = changed.size() == 1;
  for (const std::size_t g : changed)
    lightGroup(g, asked[g], one ? std::optional(firstSweeps) : std::nullopt, always);
  publish();
  if (!one || groups[changed.front()].converged) return;
  Watch newer(*this, stop, Watch::Ends::WithNewerLights);
  solution_->radiosity.solve(newer);
  keepSolution(changed.front(), asked[changed.front()], true);
  publish();
}

void LiveRadiosity::run(const std::stop_token& stop) {
  std::unique_lock lock(guard_);
  while (true) {
    changed_.wait(lock, [&] { return stop.stop_requested() || newest_.has_value(); });
    if (stop.stop_requested()) return;
    const std::vector<RadiosityLights> lights = *std::exchange(newest_, std::nullopt);
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

RadiosityGroups::RadiosityGroups(const RadiosityLights& shown, bool emissive)
    : first_(shown.punctual.size()) {
  for (std::size_t i = 0; i < first_; ++i) {
    const Light& light = shown.punctual[i];
    groups_.push_back({.name = light.name.empty() ? fmt::format("light {}", i) : light.name, .lights = {i}});
  }
  if (emissive && shown.emitters) groups_.push_back({.name = "emissive surfaces", .emitters = true});
  if (shiningSky(shown.sky) != nullptr) groups_.push_back({.name = "sky", .sky = true});
  groups_.push_back({.name = "added lights", .added = true});
}

std::vector<std::string> RadiosityGroups::names() const {
  std::vector<std::string> names;
  for (const RadiosityGroup& group : groups_) names.push_back(group.name);
  return names;
}

std::vector<RadiosityLights> RadiosityGroups::deal(const RadiosityLights& all) const {
  std::vector<RadiosityLights> dealt;
  for (const RadiosityGroup& group : groups_) {
    RadiosityLights& own = dealt.emplace_back();
    own.emitters = group.emitters && all.emitters;
    if (group.sky) {
      own.sky = all.sky;
      own.skyRotation = all.skyRotation;
    }
    for (const std::size_t i : group.lights)
      if (i < all.punctual.size()) own.punctual.push_back(all.punctual[i]);
    for (std::size_t i = first_; group.added && i < all.punctual.size(); ++i)
      own.punctual.push_back(all.punctual[i]);
  }
  return dealt;
}

}  // namespace prelight
