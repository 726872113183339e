#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cast/light_groups.h"
#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/transfer.h"
#include "relight/neighbourhood.h"
#include "relight/object_occluder.h"
#include "relight/object_shadow.h"
#include "relight/vertex_lights.h"
#include "techniques/volume/volume_receiver.h"

namespace prelight {

/// An object in a baked scene that was not part of the bake.
struct VolumeObject {
  VertexRange range;
  /// Transfer of its vertices without the scene, in its present orientation, of VolumeReceiver::ownOrder().
  HarmonicTransfer own;
  /// Part of `own` that the object reflects onto itself, [vertex][channel 3][i]; empty: nothing.
  std::vector<float> bounced = {};
};

/// Bands of lamps' light that objects reflect onto themselves. VolumeObject::bounced has at least as many.
constexpr int ownLampOrder = 3;

/// Transfer of an object's vertices.
struct ObjectTransfer {
  std::vector<float> sh;      ///< [vertex][channel 3][i]
  std::vector<float> lights;  ///< [vertex][channel 3][group]; empty: the volume has no light groups
};

/// Triangle counts of a scene's parts: those of the bake come first, then those of objects, then probes.
struct SceneParts {
  std::uint32_t baked = 0;   ///< triangles of the bake
  std::uint32_t traced = 0;  ///< triangles of bake and objects
};

/// Objects in a baked scene: the light that they hide from it, and the light of lamps with their shadows.
class ObjectScene {
 public:
  /// `lights` are the light groups of the baked scene; nullptr: none. `lights` and `device` must outlive the
  /// object.
  ObjectScene(const CompiledScene& scene, const SceneParts& parts, const GroupedLights* lights,
              const Device& device);

  /// Computes the shadows of all objects by vector occluders instead of rays.
  void shadeByOccluders(const CompiledScene& scene, std::span<const VertexRange> objects);

  /// Computes the sky light that all objects hide and send by their neighbourhoods, and shadows of lamps by
  /// vector occluders. `direct`, [vertex][i], is the SH transfer of the baked scene's vertices without
  /// bounces.
  void shadeByNeighbourhoods(const CompiledScene& scene, std::span<const VolumeObject> objects,
                             std::vector<float> direct);

  /// Returns that transfer; empty: not known.
  std::span<const float> direct() const { return direct_; }

  /// Updates the positions of objects.
  void follow(const CompiledScene& scene);

  /// Returns the light that objects hide from the baked scene's vertices, with `order` bands for the sky.
  ObjectShadow shadowOf(const CompiledScene& scene, const VertexRange& baked,
                        std::span<const VertexRange> objects, int order);

  /// Returns direct light of lamps on the baked scene's vertices with the shadows of objects; `unhidden` is
  /// that without them.
  std::vector<float> lampsPast(const CompiledScene& scene, const VertexRange& baked,
                               std::span<const float> unhidden);

  /// Adds to the direct light of lamps on an object's vertices, [vertex][channel 3][group], the light that
  /// the object reflects onto itself. Incident light is assumed to be the same all over the object.
  void addOwnBounces(const CompiledScene& scene, const VolumeObject& object, std::vector<float>& lights);

  /// Returns direct light of lamps on vertices as VertexLights does; empty if there are none.
  std::vector<float> lampsOn(const CompiledScene& scene, const VertexRange& range, bool withObjects);

 protected:
  Tracer whole_;                          ///< without probes
  Tracer walls_;                          ///< the baked scene without objects
  std::optional<VertexLights> lamps_;     ///< traced in `whole_`
  std::optional<VertexLights> unhidden_;  ///< traced in `walls_`, without objects

 private:
  std::vector<ObjectOccluder> occluders_;      ///< empty: shadows are traced
  std::vector<Neighbourhood> neighbourhoods_;  ///< empty: shadows of the sky come from occluders or rays
  std::vector<float> direct_;
  LampPlaces places_;  ///< places of the lamps
};

/// Lights objects in a baked scene at any place: from its volume, and from lamps by shadow rays. Cells that a
/// vertex does not see are excluded from interpolation, so that no light leaks through walls.
class ObjectLight : public ObjectScene {
 public:
  /// Takes the arguments of ObjectScene; `volume` must outlive the object as well.
  ObjectLight(const CompiledScene& scene, const SceneParts& parts, const VolumeTransfer& volume,
              const GroupedLights* lights, const Device& device);

  /// Returns the transfer of an object at its present place.
  ObjectTransfer transferOf(const CompiledScene& scene, const VolumeObject& object);

  /// Returns the transfer of probes, which are white convex bodies with equal numbers of vertices, one after
  /// another, that stand in the cells `voxels`. They show the values of these cells.
  ObjectTransfer transferOfProbes(const CompiledScene& scene, const VertexRange& range,
                                  std::span<const std::size_t> voxels);

 private:
  /// Cells around a vertex.
  using Corners = std::array<VolumeCorner, 8>;

  std::vector<Corners> seenCorners(const CompiledScene& scene, const VertexRange& range);
  void leaveOutHidden(const std::vector<glm::vec3>& origins, std::vector<Corners>& corners);
  void addLamps(std::optional<VertexLights>& lamps, const CompiledScene& scene, const VertexRange& range,
                ObjectTransfer& transfer);

  const VolumeTransfer& volume_;
  VolumeReceiver receiver_;
  glm::dvec3 origin_;
};

}  // namespace prelight
