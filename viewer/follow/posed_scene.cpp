#include "viewer/follow/posed_scene.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "gi/update/live_scene.h"
#include "scene/compile/compile_parts.h"
#include "scene/deform.h"
#include "scene/pose.h"
#include "techniques/registry/keyed_bake.h"
#include "viewer/frame/renderer.h"

namespace prelight::viewer {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Bounds {
  std::string name;
  glm::dvec3 lower{infinite};
  glm::dvec3 upper{-infinite};
};

/// Bounds of the nodes that have triangles, by the nodes' numbers in the file.
std::map<int, Bounds> boundsOfNodes(const CompiledScene& compiled) {
  std::map<int, Bounds> bounds;
  for (const PrimitiveRange& range : compiled.primitives) {
    if (range.triangleCount == 0) continue;
    Bounds& node = bounds[range.node];
    node.name = range.name.empty() ? "node " + std::to_string(range.node) : range.name;
    for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
      node.lower = glm::min(node.lower, glm::dvec3(compiled.positions[v]));
      node.upper = glm::max(node.upper, glm::dvec3(compiled.positions[v]));
    }
  }
  return bounds;
}

/// All but one. Parents come before what hangs on them.
std::vector<PosedScene::Node> draggedNodes(const Scene& scene, const CompiledScene& compiled, int butNot) {
  const std::map<int, Bounds> bounds = boundsOfNodes(compiled);
  std::vector<PosedScene::Node> nodes;
  std::vector<int> indexOf(scene.nodes.size(), -1);  // of scene nodes, into `nodes`
  for (const MeshNode& mesh : scene.meshNodes) {
    const auto found = bounds.find(mesh.node);
    if (found == bounds.end() || mesh.node == butNot) continue;
    const auto& [number, box] = *found;
    PosedScene::Node node{number, box.name, compiled.origin + 0.5 * (box.lower + box.upper)};
    if (mesh.sceneNode < scene.nodes.size()) {
      for (int up = scene.nodes[mesh.sceneNode].parent; up >= 0 && node.above < 0;
           up = scene.nodes[static_cast<std::size_t>(up)].parent)
        node.above = indexOf[static_cast<std::size_t>(up)];
      indexOf[mesh.sceneNode] = static_cast<int>(nodes.size());
    }
    nodes.push_back(node);
  }
  return nodes;
}

/// Whether an animation of a scene changes what its surfaces are made of.
bool animatesMaterials(const Scene& scene) {
  return std::any_of(scene.animations.begin(), scene.animations.end(), [](const Animation& animation) {
    return std::any_of(animation.properties.begin(), animation.properties.end(), [](const auto& channel) {
      return channel.property < AnimatedProperty::LightIntensity;
    });
  });
}

/// Copies the parts of a scene that poses change; the other parts are large.
Scene posable(const Scene& scene, bool withMeshes, bool withImages) {
  Scene copy;
  if (withMeshes) copy.meshes = scene.meshes;
  if (withImages) copy.images = scene.images;
  copy.nodes = scene.nodes;
  copy.meshNodes = scene.meshNodes;
  copy.skins = scene.skins;
  copy.materials = scene.materials;
  copy.lights = scene.lights;
  copy.cameras = scene.cameras;
  copy.animations = scene.animations;
  copy.moment = scene.moment;
  return copy;
}

/// Gives a scene what a pose changes of another.
void takePose(const Scene& from, Scene& to) {
  to.meshNodes = from.meshNodes;
  to.skins = from.skins;
  to.materials = from.materials;
  to.lights = from.lights;
  to.cameras = from.cameras;
  to.moment = from.moment;
}

bool hasLightInCoordinates(const RenderInputs& inputs) {
  return inputs.globalIllumination != nullptr || inputs.virtualLights != nullptr ||
         inputs.caustics != nullptr;
}

}  // namespace

PosedScene::PosedScene(const RenderInputs& inputs, PoseSources sources)
    : inputs_(inputs),
      sources_(std::move(sources)),
      keepsCoordinates_(sources_.dragsOnly || hasLightInCoordinates(inputs)),
      showsMoments_(!sources_.dragsOnly && inputs.caustics == nullptr && inputs.virtualLights == nullptr),
      compiled_(inputs.compiled),
      nodes_(draggedNodes(inputs.scene, inputs.compiled, inputs.probes ? inputs.probes->node : -1)) {
  changesMaterials_ = showsMoments_ && animatesMaterials(inputs.scene);
  if (changesMaterials_) posed_ = posable(inputs.scene, true, true);
  for (const Node& node : nodes_) shifts_.push_back({node.node, glm::dvec3(0.0)});
  if (sources_.keys == nullptr && inputs.bake != nullptr && inputs.bake->animation)
    sources_.keys = &*inputs.bake->animation;
}

RenderInputs PosedScene::shown() const {
  RenderInputs shown = inputs_.movedTo(changesMaterials_ ? *posed_ : inputs_.scene, compiled_);
  shown.posed = &bake_;
  return shown;
}

bool PosedScene::isAtRest() const {
  return !place_.moment && std::all_of(shifts_.begin(), shifts_.end(),
                                       [](const NodeShift& shift) { return shift.by == glm::dvec3(0.0); });
}

/// Adds the shifts of the nodes that a node hangs on.
std::vector<glm::dvec3> PosedScene::totalWays() const {
  std::vector<glm::dvec3> ways;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    ways.push_back(i < place_.ways.size() ? place_.ways[i] : glm::dvec3(0.0));
    if (nodes_[i].above >= 0) ways.back() += ways[static_cast<std::size_t>(nodes_[i].above)];
  }
  return ways;
}

/// Vertices as the scene is posed. Light of full shading is of the triangles that it was computed for.
void PosedScene::flatten() {
  if (!keepsCoordinates_) return flattenAnew(*posed_, compiled_);
  CompiledScene now;
  now.materials = compiled_.materials;
  flattenAnew(*posed_, now, compiled_.origin);
  if (haveSameTriangles(now, compiled_)) {
    now.materials = std::move(compiled_.materials);
    now.images = std::move(compiled_.images);
    compiled_ = std::move(now);
  } else {
    note(
        "in this pose a node is flat, turned inside out or bent apart from others of its mesh: the scene "
        "keeps its former pose, because its light belongs to its triangles");
  }
}

/// Nodes of the scene, from where the inputs or the moment have them.
void PosedScene::placeNodes() {
  if (!posed_) posed_ = posable(inputs_.scene, true, false);
  takePose(inputs_.scene, *posed_);
  if (place_.moment) {
    setPose(*posed_, place_.moment->animation, place_.moment->seconds);
    if (sources_.moves) sources_.moves(*posed_);
  }
  const std::vector<glm::dvec3> ways = totalWays();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    shifts_[i].by = ways[i];
    if (ways[i] == glm::dvec3(0.0)) continue;
    for (MeshNode& node : posed_->meshNodes)
      if (node.node == nodes_[i].node) moveNode(*posed_, node, ways[i], 0.0);
  }
}

PoseChange PosedScene::pose(const ScenePlace& asked, Shading shading) {
  ScenePlace place = asked;
  // The inputs are posed so already, with light that they have of no other pose.
  if (!showsMoments_ || place.moment == inputs_.scene.moment) place.moment.reset();
  PoseChange change;
  if (place != place_) {
    change.places = true;
    change.shapes = place.moment != place_.moment;
    place_ = std::move(place);
    placeNodes();
    change.materials = changesMaterials_ && change.shapes;
    if (change.materials) compiled_.materials = compileMaterials(*posed_);
    flatten();
    if (change.materials && inputs_.globalIllumination != nullptr)
      note("full shading: indirect light and caustics keep the materials that the scene had at first");
  }
  change.bake = followBake(shading);
  return change;
}

/// True when it is other than it was for this shading.
bool PosedScene::followBake(Shading shading) {
  if (shading == Shading::Sh && mixedFor_ != place_.moment) {
    mixTransfer();
    mixedFor_ = place_.moment;
    return true;
  }
  if (shading == Shading::Vo && movedFor_ != place_) {
    moveOccluders();
    movedFor_ = place_;
    return true;
  }
  if (!infoOf(shading).traits.followsAnimation && place_.moment)
    note(std::string(shadingName(shading)) +
         " shading stays as it was baked: only SH transfer and vector occluders follow an animation");
  return false;
}

void PosedScene::mixTransfer() {
  Bake mixed;
  if (place_.moment && sources_.keys != nullptr && sources_.keys->animation == place_.moment->animation)
    mixed = bakeAt(*sources_.keys, *posed_, shown().compiled, place_.moment->seconds);
  else if (const BentBake* bent = place_.moment ? bentBake() : nullptr; bent != nullptr)
    mixed = bent->at(compiled_);
  else if (place_.moment)
    note("the bake has no keys of the animation: its transfer stays as it was baked (bake with --animation)");
  mixed.occluders = std::move(bake_.occluders);
  bake_ = std::move(mixed);
}

const PosedOccluders* PosedScene::occluders() {
  if (sources_.occluders != nullptr) return sources_.occluders;
  if (ownOccluders_ == nullptr && inputs_.bake != nullptr && inputs_.bake->occluders) {
    const std::shared_ptr<const OccluderTransfer> rest(std::shared_ptr<void>(), &*inputs_.bake->occluders);
    ownOccluders_ = std::make_unique<const PosedOccluders>(rest, inputs_.scene, inputs_.compiled);
  }
  return ownOccluders_.get();
}

/// Returns the bake that is bent in the present pose, or nullptr if none is.
const BentBake* PosedScene::bentBake() {
  const bool own = sources_.bent == nullptr && inputs_.bake != nullptr &&
                   BentBake::servesFor(*inputs_.bake) && shapesOf(*posed_) != shapesOf(inputs_.scene);
  if (own && ownBent_ == nullptr)
    ownBent_ = std::make_unique<const BentBake>(*inputs_.bake, inputs_.compiled);
  const BentBake* bent = own ? ownBent_.get() : sources_.bent;
  if (bent != nullptr) note(bentBakeNote);
  return bent;
}

void PosedScene::moveOccluders() {
  bake_.occluders.reset();
  if (isAtRest()) return;
  try {
    if (const PosedOccluders* rest = occluders()) bake_.occluders = rest->at(*posed_, shown().compiled);
  } catch (const InputError& error) {
    note(std::string(error.what()) + "; they stay as they were baked");
  }
}

void PosedScene::note(const std::string& text) {
  if (said_.insert(text).second) notes_.push_back(text);
}

Warnings PosedScene::takeNotes() { return std::exchange(notes_, {}); }

PoseChange showPose(PosedScene& scene, Renderer& renderer, const ScenePlace& place, Shading shading) {
  const PoseChange change = scene.pose(place, shading);
  if (change.materials) renderer.materialsChanged();
  if (change.places) renderer.sceneMoved(change.shapes);
  if (change.bake) renderer.bakeChanged(shading);
  return change;
}

}  // namespace prelight::viewer
