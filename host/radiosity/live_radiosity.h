#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <glm/glm.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/plan.h"
#include "radiosity/direct_light.h"
#include "radiosity/radiosity.h"

namespace prelight {

/// Radiosity that follows changing lights, on a separate thread. Form factors are computed once, when the
/// first lights are set. If lights change faster than they can be solved for, only the newest are used; a
/// preliminary result after a few sweeps is shown before the solution converges.
class LiveRadiosity {
 public:
  /// The light is that of RadiosityBake for the same request, to a tenth of its tolerance. `scene` must
  /// outlive the object. Throws Error (OutOfMemory) if the request's memory is too small for the form
  /// factors. Computes nothing yet.
  LiveRadiosity(const CompiledScene& scene, const BakeRequest& request, const DeviceOptions& device);

  /// Stops the work in progress.
  ~LiveRadiosity();
  LiveRadiosity(const LiveRadiosity&) = delete;
  LiveRadiosity& operator=(const LiveRadiosity&) = delete;

  /// Sets lights as a single group; their sky must outlive the object.
  void setLights(const RadiosityLights& lights) { setGroups({lights}); }

  /// Sets groups of lights, [group], which are solved separately. Groups with unchanged lights are not solved
  /// again, unless the number of groups changes. The direct light of all emissive triangles belongs to one
  /// group.
  void setGroups(std::vector<RadiosityLights> groups);

  /// Returns whether further results for the present lights will come.
  bool isBusy() const;

  /// Returns the light found since the last call, [group], or nothing if there is none. Throws the exception
  /// that ended the work.
  std::optional<std::vector<VertexLight>> takeGroups();

  /// Returns the irradiance of all groups, W/m2, [vertex]; otherwise as takeGroups().
  std::optional<std::vector<glm::vec3>> take();

  /// Waits until the work is done or was ended by an exception.
  void wait() const;

  /// Returns the number of form-factor rays so far.
  std::uint64_t formFactorRays() const;

  /// Returns the number of groups solved so far.
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
  std::unique_ptr<Solution> solution_;  ///< used only by the thread

  mutable std::mutex guard_;  ///< guards the following members
  mutable std::condition_variable changed_;
  std::optional<std::vector<RadiosityLights>> newest_;
  std::optional<std::vector<VertexLight>> found_;
  std::exception_ptr failure_;
  std::uint64_t formFactorRays_ = 0;
  std::uint64_t solves_ = 0;
  bool busy_ = false;
  std::jthread thread_;  ///< last, because it uses the others
};

/// A group of lights with a separate solution. As radiosity is linear, scaling the group's brightness scales
/// its solution.
struct RadiosityGroup {
  std::string name;
  std::vector<std::size_t> lights = {};  ///< indices into RadiosityLights::punctual
  bool added = false;                    ///< whether it includes lights added later
  bool emitters = false;                 ///< whether it includes emissive triangles
  bool sky = false;                      ///< whether it includes the sky
};

/// Assigns lights to groups: each punctual light, the emissive triangles of a scene that has any, the sky,
/// and lights added later are separate groups.
class RadiosityGroups {
 public:
  /// `shown` are the initial lights; `emissive` says whether the scene has emissive triangles.
  RadiosityGroups(const RadiosityLights& shown, bool emissive);

  const std::vector<RadiosityGroup>& groups() const { return groups_; }
  std::vector<std::string> names() const;

  /// Returns the part of all lights that belongs to each group, [group].
  std::vector<RadiosityLights> deal(const RadiosityLights& all) const;

 private:
  std::vector<RadiosityGroup> groups_;
  std::size_t first_;  ///< number of initial lights
};

}  // namespace prelight
