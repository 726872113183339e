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

  /// From now on; their sky outlives it.
  void setLights(const RadiosityLights& lights);

  /// There is more to come of the lights that were set.
  bool isBusy() const;

  /// Irradiance that was found since the last call, W/m2, [vertex]; none: nothing new. Throws what ended the
  /// work.
  std::optional<std::vector<glm::vec3>> take();

  /// Returns when the work is done, or was ended by an exception.
  void wait() const;

  /// Rays of form factors so far.
  std::uint64_t formFactorRays() const;

 private:
  struct Solution;
  class Watch;

  void run(const std::stop_token& stop);
  void follow(const RadiosityLights& lights, const std::stop_token& stop);
  void publish();
  bool hasNewer() const;

  const CompiledScene& scene_;
  BakeRequest request_;
  DeviceOptions device_;
  std::unique_ptr<Solution> solution_;  ///< the thread's alone

  mutable std::mutex guard_;  ///< of what follows
  mutable std::condition_variable changed_;
  std::optional<RadiosityLights> newest_;
  std::optional<std::vector<glm::vec3>> found_;
  std::exception_ptr failure_;
  std::uint64_t formFactorRays_ = 0;
  bool busy_ = false;
  std::jthread thread_;  ///< last: it uses the others
};

}  // namespace prelight
