#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gi/update/live_photons.h"
#include "gi/update/live_scene.h"
#include "integrators/virtual_light_power.h"
#include "integrators/virtual_lights.h"
#include "prelight/options.h"
#include "prelight/picture.h"
#include "prelight/progress.h"
#include "prelight/shading.h"

namespace prelight {

template <>
std::span<const Option<InstantOptions>> optionsOf<InstantOptions>();

/// The virtual lights of a picture.
struct VirtualLightSet {
  std::vector<device::VirtualLight> lights;  ///< in the order of their paths
  float leastSquare = 0.0f;    ///< m2, square of the distance below which a light counts as at that distance
  std::uint32_t renewals = 0;  ///< as in InstantOptions
};

/// Virtual point lights (Keller 1997) of a scene with moving nodes and lights: only paths that a change
/// affects are traced again, a few per frame, while the others keep their lights (Laine et al. 2007). Waiting
/// paths are out of date; when none waits, all lights are those of the present scene.
class LiveVirtualLights {
 public:
  /// Makes all lights. Without changes they equal those of the reference's first pass. The scene must have a
  /// triangle. The sky may be null; it and the device must outlive the object. Throws Interrupted.
  LiveVirtualLights(const Scene& scene, CompiledScene compiled, const Environment* sky, double skyRotation,
                    const InstantOptions& options, const Device& device, Progress& progress);

  /// Changes for the next frame, as those of LiveScene.
  void moveNode(int node, const RigidMotion& motion) { scene_.moveNode(node, motion); }
  void pose(const CompiledScene& posed) { scene_.pose(posed); }
  void setLight(std::size_t index, const Light& light) { scene_.setLight(index, light); }
  void setSkyRotation(double angle);  ///< radians, as LitScene::skyRotation
  double skyRotation() const { return skyRotation_; }

  /// Does a frame's share of the work. Returns whether the lights have changed.
  bool advance(Progress& progress);

  /// Returns whether no path waits.
  bool settled() const { return photons_->settled(); }

  const LiveScene& scene() const { return scene_; }
  const VirtualLightSet& lights() const { return lights_; }
  std::uint64_t pathCount() const { return photons_->pathCount(); }

 private:
  void makePhotons(Progress& progress);
  void makeLights();

  LiveScene scene_;
  InstantOptions options_;
  TransportScene transport_;
  MovingTriangles moving_;
  double skyRotation_;
  bool skyTurned_ = false;
  std::unique_ptr<VirtualLightMaker> maker_;
  std::unique_ptr<VirtualLightPower> power_;
  std::unique_ptr<LivePhotons> photons_;
  VirtualLightSet lights_;
};

}  // namespace prelight
