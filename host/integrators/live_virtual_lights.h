#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gi/update/follow_change.h"
#include "gi/update/live_photons.h"
#include "integrators/virtual_light_maker.h"
#include "integrators/virtual_light_power.h"
#include "prelight/picture.h"
#include "prelight/progress.h"

namespace prelight {

struct VirtualLightOptions {
  std::uint64_t paths = 64;    ///< that leave lights, about; more where most of them leave none
  std::uint32_t renewals = 8;  ///< paths that a frame follows again at most; 0: all that have changed
  double nearest = 0.0;  ///< m; a virtual light nearer than that counts as there, and what that takes is
                         ///< given back within the distance; 0: leastSquareOf()
  int depth = 16;        ///< most segments of a path, camera to light
  std::uint64_t seed = 0;

  bool operator==(const VirtualLightOptions&) const = default;
};

/// What virtual lights a picture is lit by.
struct VirtualLightSet {
  std::vector<device::VirtualLight> lights;  ///< in the order of their paths
  float leastSquare = 0.0f;                  ///< m2; nearer than its root a light counts as at that distance
  std::uint32_t renewals = 0;                ///< VirtualLightOptions'
};

/// Virtual point lights (Keller 1997) of a scene in which nodes and lights move: only paths that a change
/// concerns are followed again, a few a frame, and the others keep their lights (Laine et al. 2007). Those
/// that wait are as they were; when none waits, all lights are those of the scene as it is.
class LiveVirtualLights {
 public:
  /// Makes all lights; without change they are those of the reference's first pass. The scene must have a
  /// triangle. The sky may be null; it and the device outlive it. Throws Interrupted.
  LiveVirtualLights(const Scene& scene, CompiledScene compiled, const Environment* sky, double skyRotation,
                    const VirtualLightOptions& options, const Device& device, Progress& progress);

  /// Changes that the next frame sees: LiveScene's.
  void moveNode(int node, const RigidMotion& motion) { scene_.moveNode(node, motion); }
  void pose(const CompiledScene& posed) { scene_.pose(posed); }
  void setLight(std::size_t index, const Light& light) { scene_.setLight(index, light); }
  void setSkyRotation(double angle);  ///< radians, as LitScene::skyRotation
  double skyRotation() const { return skyRotation_; }

  /// A frame's share of the work; true: the lights are others now.
  bool advance(Progress& progress);

  /// No path waits.
  bool settled() const { return photons_->settled(); }

  const LiveScene& scene() const { return scene_; }
  const VirtualLightSet& lights() const { return lights_; }
  std::uint64_t pathCount() const { return photons_->pathCount(); }

 private:
  void makePhotons(Progress& progress);
  void makeLights();

  LiveScene scene_;
  VirtualLightOptions options_;
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
