#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gi/global_illumination.h"
#include "gi/update/follow_change.h"
#include "gi/update/live_approximation.h"
#include "gi/update/live_gather.h"
#include "gi/update/live_photons.h"
#include "gi/update/live_scene.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/picture.h"
#include "prelight/plan.h"
#include "prelight/progress.h"

namespace prelight {

struct LiveLightOptions {
  std::uint64_t photons = 20000;  ///< of the approximation that is gathered from
  std::uint32_t groupSize = 40;   ///< photons
  ChangeDetection detection = ChangeDetection::Flights;
  std::uint32_t photonsPerFrame = 0;  ///< sent again at most; 0: all that change
  int nearestPhotons = leastNearestOfAll;
  std::uint32_t texels = 4096;             ///< of the light map, about
  std::uint32_t estimatesPerFrame = 1024;  ///< texels of the approximation, about; 0: all that change
  LiveGatherOptions gather;
  std::uint64_t causticPhotons = 10000;
  std::uint32_t causticFrames = 8;  ///< in which all of them are sent again at the latest
  std::uint64_t seed = 0;
  double thinBeyond = 0.0;  ///< m: lamps farther from the eye have fewer photons, see PhotonThinning; 0: none
  std::optional<glm::dvec3> eye;  ///< world space; none: no lamp is thinned until setEye()
};

/// What a frame did.
struct LiveFrame {
  PhotonFrame photons, caustics;
  std::uint32_t surfaces = 0;   ///< whose approximation was estimated again
  std::uint32_t estimates = 0;  ///< texels of it
  GatherFrame gather;
  bool causticsChanged = false;
  bool shownChanged = false;
  std::vector<std::pair<std::string, double>> stageSeconds;

  std::uint64_t rays() const { return photons.rays + caustics.rays + gather.rays; }
};

/// Indirect light and caustics of a scene whose objects and lights move, kept up to date a little a frame
/// (Larsen 2004): photons whose ways have changed are sent again, the approximated illumination is estimated
/// again where they came or went, and texels are gathered again by greatest change. What no change reaches
/// costs nothing.
class LiveLight {
 public:
  /// Computes everything. The scene must have a triangle. `movable`: nodes that will move beside those of
  /// animations: room is made for both in the tree at once, and they are no walls; others may move, too. The
  /// sky may be null; all but the scene's copies outlive it. Throws Interrupted.
  LiveLight(const Scene& scene, CompiledScene compiled, const Environment* sky, double skyRotation,
            const LiveLightOptions& options, std::span<const int> movable, const Device& device,
            Progress& progress);
  ~LiveLight();

  /// Changes that the next frame sees: LiveScene's.
  void moveNode(int node, const RigidMotion& motion);
  void pose(const CompiledScene& posed);
  void setLight(std::size_t index, const Light& light);
  void setSkyRotation(double angle);  ///< radians, as LitScene::skyRotation
  double skyRotation() const { return skyRotation_; }

  /// Where what is shown is seen from, world space. Frames go on until light is as that asks for.
  void setEye(const glm::dvec3& eye);

  LiveFrame advance(Progress& progress);

  /// Everything again, at once: what frames come to.
  void recompute(Progress& progress);

  /// Nothing waits: further frames change nothing and cost nothing.
  bool settled() const;

  const LiveScene& scene() const { return scene_; }
  const LightMapLayout& layout() const { return layout_; }
  /// Shown, W/m2, [place of the layout's texels]; empty where the plan has none.
  std::span<const glm::vec3> indirect() const;
  std::vector<device::Photon> caustics() const;
  const LivePhotons* photons() const { return photons_.get(); }
  const LivePhotons* causticPhotons() const { return caustics_.get(); }

  /// Which passes run, with reasons.
  const std::vector<PlannedPass>& plan() const { return plan_; }

 private:
  SceneChange takeChanges();
  bool follow(const SceneChange& change);
  void makeLight(Progress& progress);

  LiveScene scene_;
  LiveLightOptions options_;
  const Device& device_;
  LightMapLayout layout_;
  SurfaceRegions regions_;
  TransportScene transport_;
  MovingTriangles moving_;
  double skyRotation_;
  bool skyTurned_ = false;
  std::vector<PlannedPass> plan_;
  std::unique_ptr<LivePhotons> photons_, caustics_;
  std::unique_ptr<LiveApproximation> approximation_;
  std::unique_ptr<LiveGather> gather_;
};

/// How its caustics are looked up now.
CausticMap causticsOf(const LiveLight& live);

/// Sets a light map of live light's layout to what it shows.
void setIrradiance(const LiveLight& live, LightMap& map);

/// What live light shows now, as pictures look it up.
GlobalIllumination illuminationOf(const LiveLight& live);

}  // namespace prelight
