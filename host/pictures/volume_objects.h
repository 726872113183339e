#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pictures/placed_objects.h"
#include "prelight/bake.h"
#include "prelight/device.h"
#include "prelight/plan.h"
#include "relight/object_light.h"
#include "relight/shadowed_transfer.h"
#include "viewer/object_follower.h"
#include "viewer/render.h"

namespace prelight::pictures {

/// What lights objects that were not baked with a scene.
enum class ObjectLighting : std::uint8_t {
  Auto,    ///< the bake's volume where there is one, else cube maps
  Volume,  ///< the bake's volume
  Cube,    ///< cube maps of the lit scene, drawn where the objects stand (viewer/object_cubes.h)
};

/// What makes the shadows of objects on a scene.
enum class ObjectShadows : std::uint8_t {
  Rays,           ///< to objects and to lamps
  Occluders,      ///< the objects as vector occluders (relight/object_occluder.h)
  Neighbourhood,  ///< matrices of transfer around the objects (relight/neighbourhood.h)
};

/// What is put into a scene, and what lights it.
struct VolumeObjectOptions {
  std::vector<PlacedObject> objects;
  bool probes = false;
  ObjectLighting lighting = ObjectLighting::Auto;
  ObjectShadows shadows = ObjectShadows::Rays;

  bool any() const { return probes || !objects.empty(); }
};

/// Objects and probes among a scene, whose transfer in the scene's bake follows them. Where cube maps light
/// objects, that is the direct light of lamps in groups alone.
class VolumeObjects {
 public:
  /// Adds them to the scene, and transfer of their vertices to the bake, of which only what they have as well
  /// is kept. `named` are the groups that lights were baked in. Throws InputError where a volume is needed
  /// and the bake has none.
  VolumeObjects(DrawingSession& session, const VolumeObjectOptions& options,
                const std::vector<LightGroupRequest>& named, const DeviceOptions& device, OpenedScene& loaded,
                Bake& bake);

  /// They stand where `scene` has them. Returns the vertices whose transfer in the bake is another now.
  std::vector<VertexRange> update(const CompiledScene& scene, Bake& bake);

  /// How they are drawn; none: there are no probes.
  const std::optional<viewer::DrawnProbes>& probes() const { return probes_; }

  /// Objects that the viewer lights by cube maps.
  std::span<const VertexRange> cubeLit() const { return cubeLit_; }

  /// [vertex of those], what they leave themselves of an even light.
  std::span<const glm::vec3> cubeOpenness() const { return cubeOpenness_; }

  /// Whether cube maps light them, and why.
  PlannedPass plan() const;

  /// The first object's node, -1: there is none.
  int firstNode() const { return firstNode_; }

 private:
  void addProbes(Scene& scene);
  void bakeOwn(DrawingSession& session, const std::vector<AddedObject>& added, const CompiledScene& scene,
               int order, const DeviceOptions& device);
  void groupLamps(const CompiledScene& scene, std::size_t ownMaterials,
                  const std::vector<LightGroupRequest>& named, const Bake& bake);
  void makeShadows(ObjectShadows shadows, const CompiledScene& scene, std::vector<float> direct);
  void lightObjects(const CompiledScene& scene, Bake& bake);
  ObjectTransfer transferOf(const CompiledScene& scene, const VolumeObject& object);
  void store(const VertexRange& range, const ObjectTransfer& transfer, Bake& bake) const;

  std::optional<VolumeTransfer> volume_;  ///< none: cube maps light objects
  ObjectLighting asked_;
  Device device_;
  std::optional<GroupedLights> lamps_;
  std::vector<VolumeObject> objects_;
  std::vector<VertexRange> cubeLit_;
  std::vector<glm::vec3> cubeOpenness_;
  std::vector<std::size_t> probeVoxels_;
  VertexRange probeRange_;
  std::optional<viewer::DrawnProbes> probes_;
  int firstNode_ = -1;
  std::unique_ptr<ObjectScene> among_;
  ObjectLight* light_ = nullptr;  ///< `among_` with a volume
  VertexRange baked_;
  std::unique_ptr<ShadowedTransfer> shadowed_;
};

/// Keeps the objects of a window lit as they are moved: `bake` is the one that it shows.
class FollowingObjects final : public viewer::ObjectFollower {
 public:
  FollowingObjects(VolumeObjects& objects, Bake& bake) : objects_(objects), bake_(bake) {}

  std::vector<VertexRange> update(const CompiledScene& scene) override {
    return objects_.update(scene, bake_);
  }

 private:
  VolumeObjects& objects_;
  Bake& bake_;
};

}  // namespace prelight::pictures
