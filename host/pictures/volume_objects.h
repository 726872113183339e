#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pictures/placed_objects.h"
#include "prelight/bake.h"
#include "prelight/device.h"
#include "prelight/draw.h"
#include "prelight/plan.h"
#include "relight/object_light.h"
#include "relight/shadowed_transfer.h"
#include "viewer/follow/object_follower.h"
#include "viewer/frame/render.h"

namespace prelight::pictures {

/// Objects and probes in a scene, whose transfer in the scene's bake follows them. If cube maps light the
/// objects, this transfer is only the direct light of lamps in groups.
class VolumeObjects {
 public:
  /// Adds the objects to the scene, and the transfer of their vertices to the bake, of which only the
  /// techniques that they can have remain. `named` are the groups in which lights were baked. Throws
  /// InputError if a volume is needed and the bake has none.
  VolumeObjects(DrawingSession& session, const ObjectOptions& options,
                const std::vector<LightGroupRequest>& named, const DeviceOptions& device, LoadedScene& loaded,
                Bake& bake);

  /// Moves the objects to their places in `scene`. Returns the vertices whose transfer in the bake has
  /// changed.
  std::vector<VertexRange> update(const CompiledScene& scene, Bake& bake);

  /// How the probes are drawn; none: there are no probes.
  const std::optional<viewer::DrawnProbes>& probes() const { return probes_; }

  /// The vertices of the objects that the viewer lights by cube maps.
  std::span<const VertexRange> cubeLit() const { return cubeLit_; }

  /// The part of an even light that an object itself does not hide, [vertex of cubeLit()].
  std::span<const glm::vec3> cubeOpenness() const { return cubeOpenness_; }

  /// Returns whether cube maps light the objects, and why.
  PlannedPass plan() const;

  /// The node of the first object, or -1 if there is none.
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

  std::optional<VolumeTransfer> volume_;  ///< none: cube maps light the objects
  ObjectLighting asked_;
  std::shared_ptr<const Device> device_;
  std::optional<GroupedLights> lamps_;
  std::vector<VolumeObject> objects_;
  std::vector<VertexRange> cubeLit_;
  std::vector<glm::vec3> cubeOpenness_;
  std::vector<std::size_t> probeVoxels_;
  VertexRange probeRange_;
  std::optional<viewer::DrawnProbes> probes_;
  int firstNode_ = -1;
  std::unique_ptr<ObjectScene> among_;
  ObjectLight* light_ = nullptr;  ///< `among_` if there is a volume
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
