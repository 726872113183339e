#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "cli/placed_objects.h"
#include "prelight/bake.h"
#include "prelight/device.h"
#include "relight/object_light.h"
#include "relight/shadowed_transfer.h"
#include "viewer/object_follower.h"
#include "viewer/render.h"

namespace prelight::cli {

/// What of a picture its baked volume lights.
struct VolumeObjectOptions {
  std::vector<PlacedObject> objects;
  bool probes = false;

  bool any() const { return probes || !objects.empty(); }
};

/// Objects and probes among a scene, whose transfer in the scene's bake follows them.
class VolumeObjects {
 public:
  /// Adds them to the scene, and transfer of their vertices to the bake, of which only what they have as well
  /// is kept. `named` are the groups that lights were baked in. Throws InputError for a bake without a
  /// volume.
  VolumeObjects(Session& session, const VolumeObjectOptions& options,
                const std::vector<LightGroupRequest>& named, const DeviceOptions& device, LoadedScene& loaded,
                Bake& bake);

  /// They stand where `scene` has them. Returns the vertices whose transfer in the bake is another now.
  std::vector<VertexRange> update(const CompiledScene& scene, Bake& bake);

  /// How they are drawn; none: there are no probes.
  const std::optional<viewer::DrawnProbes>& probes() const { return probes_; }

  /// The first object's node, -1: there is none.
  int firstNode() const { return firstNode_; }

 private:
  void addProbes(Scene& scene);
  void bakeOwn(Session& session, const std::vector<AddedObject>& added, const CompiledScene& scene,
               const DeviceOptions& device);
  void groupLamps(const CompiledScene& scene, std::size_t ownMaterials,
                  const std::vector<LightGroupRequest>& named, const Bake& bake);
  void lightObjects(const CompiledScene& scene, Bake& bake);
  void store(const VertexRange& range, const ObjectTransfer& transfer, Bake& bake) const;

  VolumeTransfer volume_;
  Device device_;
  std::optional<GroupedLights> lamps_;
  std::vector<VolumeObject> objects_;
  std::vector<std::size_t> probeVoxels_;
  VertexRange probeRange_;
  std::optional<viewer::DrawnProbes> probes_;
  int firstNode_ = -1;
  std::unique_ptr<ObjectLight> light_;
  VertexRange baked_;
  std::unique_ptr<ShadowedTransfer> shadowed_;
};

/// The same for a window, whose bake this is.
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

}  // namespace prelight::cli
