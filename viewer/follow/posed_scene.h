#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "occluders/posed_occluders.h"
#include "techniques/registry/keyed_bake.h"
#include "viewer/core/render_inputs.h"
#include "viewer/follow/light_follower.h"

namespace prelight::viewer {

/// How a scene stands: at a moment of one of its animations, from where nodes have been dragged.
struct ScenePlace {
  std::optional<SceneMoment> moment;  ///< none: as the inputs of pictures have it
  std::vector<glm::dvec3> ways;       ///< [node that can be dragged], m; of none: they have not been

  bool operator==(const ScenePlace&) const = default;
};

/// The parts of a scene that a pose has changed.
struct PoseChange {
  bool places = false;  ///< of vertices
  bool shapes = false;  ///< normals, triangles and whatever else vertices carry
  bool materials = false;
  bool bake = false;  ///< light of the shading that is shown

  bool any() const { return places || bake; }
};

/// Further inputs of a pose, for pictures' inputs that are posed already. The referents outlive it.
struct PoseSources {
  const AnimatedTransfer* keys = nullptr;     ///< nullptr: those of the inputs' bake
  const PosedOccluders* occluders = nullptr;  ///< nullptr: made of the inputs' bake
  const BentBake* bent = nullptr;             ///< nullptr: made of the inputs' bake
  std::function<void(Scene&)> moves;          ///< of nodes, once an animation has placed them; empty: none
  bool dragsOnly = false;                     ///< others move nodes in the inputs' coordinates: no moments
};

/// A scene as a window shows it. Vertices, materials, lights, cameras and what its bake carries of them all
/// follow one place.
///
/// Where light is computed in the scene's coordinates (global illumination, caustics) those stay.
class PosedScene {
 public:
  /// A node with triangles.
  struct Node {
    int node = 0;            ///< index in the glTF file
    std::string name;        ///< "node N" where the file has none
    glm::dvec3 center{0.0};  ///< middle of its bounds as the inputs have it, world space
    int above = -1;          ///< into nodes(): the nearest that it hangs on; -1: none
  };

  /// The inputs' referents outlive it.
  explicit PosedScene(const RenderInputs& inputs, PoseSources sources = {});
  PosedScene(const PosedScene&) = delete;  // shown() points into it
  PosedScene& operator=(const PosedScene&) = delete;

  /// The inputs in its pose, whatever that becomes.
  RenderInputs shown() const;

  const std::vector<Node>& nodes() const { return nodes_; }
  std::span<const NodeShift> shifts() const { return shifts_; }
  bool showsMoments() const { return showsMoments_; }

  /// Lights and cameras as the pose has them.
  const std::vector<Light>& lights() const { return stood().lights; }
  const std::vector<Camera>& cameras() const { return stood().cameras; }

  /// Poses it, and what its bake carries for a shading.
  PoseChange pose(const ScenePlace& place, Shading shading);

  /// Messages about parts that do not follow the pose; each is returned once.
  Warnings takeNotes();

 private:
  const Scene& stood() const { return posed_ ? *posed_ : inputs_.scene; }
  bool isAtRest() const;
  std::vector<glm::dvec3> totalWays() const;
  void placeNodes();
  void flatten();
  bool followBake(Shading shading);
  void mixTransfer();
  void moveOccluders();
  const PosedOccluders* occluders();
  const BentBake* bentBake();
  void note(const std::string& text);

  RenderInputs inputs_;
  PoseSources sources_;
  bool keepsCoordinates_;
  bool showsMoments_;
  CompiledScene compiled_;
  std::optional<Scene> posed_;     ///< once it stands elsewhere than the inputs'
  bool changesMaterials_ = false;  ///< an animation does: `posed_` has images then, and is there at once
  std::vector<Node> nodes_;
  std::vector<NodeShift> shifts_;
  ScenePlace place_;
  Bake bake_;                            ///< of the pose
  std::optional<SceneMoment> mixedFor_;  ///< what its transfer is of
  ScenePlace movedFor_;                  ///< what its occluders are of
  std::unique_ptr<const PosedOccluders> ownOccluders_;
  std::unique_ptr<const BentBake> ownBent_;
  std::set<std::string> said_;
  Warnings notes_;
};

/// Poses a scene and tells its renderer what has changed.
PoseChange showPose(PosedScene& scene, Renderer& renderer, const ScenePlace& place, Shading shading);

}  // namespace prelight::viewer
