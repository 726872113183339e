#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/clocks.h"
#include "gi/global_illumination.h"
#include "gi/update/coarse_light.h"
#include "gi/update/frame_budget.h"
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

/// Options of LiveLight.
struct LiveLightOptions {
  /// Seconds of work per frame; 0: only the numbers per frame below limit it. A frame with a change computes
  /// the coarse light, even if that takes longer.
  double frameSeconds = 0.0;
  FrameBudget::Clock clock;  ///< measures costs; none: usual costs count, so that runs are alike
  /// Texel size of the coarse light, in texels of the fine one; 0: no coarse light, and fine light is updated
  /// in frames with changes, too.
  std::uint32_t coarser = 0;
  std::uint64_t photons = 20000;  ///< photons of the approximation
  std::uint32_t groupSize = 40;   ///< photons per group
  ChangeDetection detection = ChangeDetection::Flights;
  std::uint32_t photonsPerFrame = 0;  ///< most photons sent again per frame; 0: all that change
  int nearestPhotons = leastNearestOfAll;
  std::uint32_t texels = 4096;          ///< approximate number of the light map's texels
  std::uint32_t estimatesPerFrame = 0;  ///< most texels estimated per frame; 0: all that change
  LiveGatherOptions gather;
  std::uint64_t causticPhotons = 10000;
  std::uint32_t causticFrames = 8;  ///< most frames until all caustic photons are sent again
  std::uint64_t seed = 0;
  /// m; lamps farther from the eye have fewer photons, see PhotonThinning; 0: none are thinned
  double thinBeyond = 0.0;
  std::optional<glm::dvec3> eye;  ///< world space; none: no lamp is thinned until setEye()
};

/// Work of one frame.
struct LiveFrame {
  PhotonFrame photons, caustics;
  std::uint32_t surfaces = 0;   ///< surfaces that were estimated again
  std::uint32_t estimates = 0;  ///< texels of these
  GatherFrame gather;
  std::uint64_t coarseRays = 0;  ///< rays of the coarse light's final gathering
  bool causticsChanged = false;
  bool shownChanged = false;
  std::vector<std::pair<std::string, double>> stageSeconds;

  std::uint64_t rays() const { return photons.rays + caustics.rays + gather.rays + coarseRays; }
};

/// Returns the options of light that follows a window: what a frame may take, and how soon changes show.
LiveLightOptions optionsOfWindows();

/// Indirect light and caustics of a scene with moving objects and lights, updated a little per frame (Larsen
/// 2004): photons whose paths have changed are sent again, the approximation is estimated again where photons
/// came or went, and texels are gathered again in order of change. Unaffected parts cost nothing.
class LiveLight {
 public:
  /// Computes all light. The scene must have a triangle. `movable` are nodes that will move, besides those of
  /// animations; the tree is prepared for both, and they do not count as walls. Other nodes may move, too.
  /// The sky may be null. All arguments but the scene's copies must outlive the object. Throws Interrupted.
  LiveLight(const Scene& scene, CompiledScene compiled, const Environment* sky, double skyRotation,
            const LiveLightOptions& options, std::span<const int> movable, const Device& device,
            Progress& progress);
  ~LiveLight();

  /// Changes for the next frame, as those of LiveScene.
  void moveNode(int node, const RigidMotion& motion);
  void pose(const CompiledScene& posed);
  void setLight(std::size_t index, const Light& light);
  void setSkyRotation(double angle);  ///< radians, as LitScene::skyRotation
  double skyRotation() const { return skyRotation_; }

  /// Sets the viewer's position in world space. Later frames adapt the light to it.
  void setEye(const glm::dvec3& eye);

  /// Does the work of one frame.
  LiveFrame advance(Progress& progress);

  /// Computes all light anew at once, with the result that frames converge to.
  void recompute(Progress& progress);

  /// Returns whether nothing waits, so that further frames change nothing and cost nothing.
  bool settled() const;

  const LiveScene& scene() const { return scene_; }
  const LightMapLayout& layout() const { return layout_; }
  /// Returns the light shown, W/m2, [place of the layout's texels]; empty if the plan has no indirect light.
  std::span<const glm::vec3> indirect() const;
  /// Returns the irradiance that gathering looks up, W/m2, and the expected change of texels that wait
  /// (LiveGather::expectedChanges()), both [place of the layout's texels]; empty as indirect().
  std::span<const glm::vec3> approximation() const;
  std::vector<double> expectedChanges() const;
  std::vector<device::Photon> caustics() const;
  const LivePhotons* photons() const { return photons_.get(); }
  const LivePhotons* causticPhotons() const { return caustics_.get(); }

  /// Returns the passes with the reasons why they run or not.
  const std::vector<PlannedPass>& plan() const { return plan_; }

 private:
  SceneChange takeChanges();
  bool follow(const SceneChange& change);
  void makeLight(Progress& progress);
  void makeIndirect(Progress& progress);
  void advanceCaustics(LiveFrame& frame, Progress& progress);
  void advanceCoarse(LiveFrame& frame, StageClock& stages, Progress& progress);
  void advancePhotons(LiveFrame& frame, Progress& progress);
  void advanceEstimates(LiveFrame& frame);
  void advanceFine(LiveFrame& frame, StageClock& stages, Progress& progress);

  LiveScene scene_;
  LiveLightOptions options_;
  const Device& device_;
  LightMapLayout layout_, coarseLayout_;
  FrameBudget budget_;
  SurfaceRegions regions_;
  TransportScene transport_;
  MovingTriangles moving_;
  double skyRotation_;
  bool skyTurned_ = false;
  std::vector<PlannedPass> plan_;
  std::unique_ptr<LivePhotons> photons_, caustics_;
  std::unique_ptr<LiveApproximation> approximation_;
  std::unique_ptr<CoarseLight> coarse_;
  std::unique_ptr<LiveGather> gather_;
};

/// Returns how the caustics are looked up now.
CausticMap causticsOf(const LiveLight& live);

/// Sets the values of a light map with live light's layout to the light shown.
void setIrradiance(const LiveLight& live, LightMap& map);

/// Returns the light shown now in the form that pictures look up.
GlobalIllumination illuminationOf(const LiveLight& live);

}  // namespace prelight
