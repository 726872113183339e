#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <glm/glm.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/plan.h"
#include "radiosity/direct_light.h"
#include "radiosity/radiosity.h"

namespace prelight {

/// Radiosity that follows its lights, on a thread of its own. Form factors are found when the first lights
/// come, and never again. Of lights that come faster than they can be solved for all but the newest are
/// passed over; what has been found after a few sweeps is shown before the solution is complete.
class LiveRadiosity {
 public:
  /// Light is that of RadiosityBake with the same request, to a tenth of its tolerance. `scene` outlives it.
  /// Throws Error (OutOfMemory) where the request's memory does not hold the form factors. Nothing is
  /// computed yet.
  LiveRadiosity(const CompiledScene& scene, const BakeRequest& request, const DeviceOptions& device);

  /// Gives up what is under way.
  ~LiveRadiosity();
  LiveRadiosity(const LiveRadiosity&) = delete;
  LiveRadiosity& operator=(const LiveRadiosity&) = delete;

  /// From now on, one group of them; their sky outlives it.
  void setLights(const RadiosityLights& lights) { setGroups({lights}); }

  /// [group], solved one by one. Groups that shine as they did are not solved again, unless their number is
  /// another. Direct light of all emissive triangles is that of one group.
  void setGroups(std::vector<RadiosityLights> groups);

  /// There is more to come of the lights that were set.
  bool isBusy() const;

  /// Light that was found since the last call, [group]; none: nothing new. Throws what ended the work.
  std::optional<std::vector<VertexLight>> takeGroups();

  /// The irradiance of all groups, W/m2, [vertex]; as takeGroups().
  std::optional<std::vector<glm::vec3>> take();

  /// Returns when the work is done, or was ended by an exception.
  void wait() const;

  /// Rays of form factors so far.
  std::uint64_t formFactorRays() const;

  /// Of groups, so far.
  std::uint64_t solves() const;

 private:
  struct Solution;
  class Watch;

  void run(const std::stop_token& stop);
  void follow(const std::vector<RadiosityLights>& groups, const std::stop_token& stop);
  void lightGroup(std::size_t index, const RadiosityLights& lights, std::optional<double> sweeps,
                  Progress& progress);
  void keepSolution(std::size_t index, const RadiosityLights& lights, bool converged);
  void publish();
  bool hasNewer() const;

  const CompiledScene& scene_;
  BakeRequest request_;
  DeviceOptions device_;
  std::unique_ptr<Solution> solution_;  ///< the thread's alone

  mutable std::mutex guard_;  ///< of what follows
  mutable std::condition_variable changed_;
  std::optional<std::vector<RadiosityLights>> newest_;
  std::optional<std::vector<VertexLight>> found_;
  std::exception_ptr failure_;
  std::uint64_t formFactorRays_ = 0;
  std::uint64_t solves_ = 0;
  bool busy_ = false;
  std::jthread thread_;  ///< last: it uses the others
};

}  // namespace prelight
