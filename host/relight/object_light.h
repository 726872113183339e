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
#include "transfer/volume_receiver.h"

namespace prelight {

/// An object that stands in a baked scene without having been baked with it.
struct VolumeObject {
  VertexRange range;
  HarmonicTransfer own;  ///< of its vertices without the scene, as it is turned; VolumeReceiver::ownOrder()
  /// Of it, what the object reflects onto itself, [vertex][channel 3][i]; empty: nothing.
  std::vector<float> bounced = {};
};

/// Bands of lamps' light, as objects reflect it onto themselves: VolumeObject::bounced has as many or more.
constexpr int ownLampOrder = 3;

/// Transfer of an object's vertices.
struct ObjectTransfer {
  std::vector<float> sh;      ///< [vertex][channel 3][i]
  std::vector<float> lights;  ///< [vertex][channel 3][group]; empty: the volume has no groups of lights
};

/// What the triangles of a scene are: those that it was baked with, then those of objects, then probes.
struct SceneParts {
  std::uint32_t baked = 0;   ///< triangles
  std::uint32_t traced = 0;  ///< and those of objects
};

/// Objects among a baked scene: what they hide from it, and the light of lamps with their shadows.
class ObjectScene {
 public:
  /// `lights`: groups of those of the baked scene; nullptr: none. `lights` and `device` outlive it.
  ObjectScene(const CompiledScene& scene, const SceneParts& parts, const GroupedLights* lights,
              const Device& device);

  /// Has the shadows of these objects, which are all, made by vector occluders in place of rays.
  void shadeByOccluders(const CompiledScene& scene, std::span<const VertexRange> objects);

  /// Has what these objects, which are all, hide of the sky and send of it found in their neighbourhoods, and
  /// shadows of lamps made by vector occluders. `direct`: SH transfer of the baked scene's vertices without
  /// bounces, [vertex][i].
  void shadeByNeighbourhoods(const CompiledScene& scene, std::span<const VolumeObject> objects,
                             std::vector<float> direct);

  /// That transfer; empty: not known.
  std::span<const float> direct() const { return direct_; }

  /// Objects are at other places.
  void follow(const CompiledScene& scene);

  /// What objects hide from the baked scene's vertices, with bands of the sky.
  ObjectShadow shadowOf(const CompiledScene& scene, const VertexRange& baked,
                        std::span<const VertexRange> objects, int order);

  /// Direct light of lamps on the baked scene's vertices past objects; `unhidden`: without them.
  std::vector<float> lampsPast(const CompiledScene& scene, const VertexRange& baked,
                               std::span<const float> unhidden);

  /// Adds what an object reflects onto itself of lamps, whose light is taken to arrive alike all over it, to
  /// their direct light on its vertices, [vertex][channel 3][group].
  void addOwnBounces(const CompiledScene& scene, const VolumeObject& object, std::vector<float>& lights);

  /// Direct light of lamps on vertices, as VertexLights gives it; empty: there are none.
  std::vector<float> lampsOn(const CompiledScene& scene, const VertexRange& range, bool withObjects);

 protected:
  Tracer whole_;                          ///< without probes
  Tracer walls_;                          ///< the baked scene alone
  std::optional<VertexLights> lamps_;     ///< in `whole_`
  std::optional<VertexLights> unhidden_;  ///< by objects

 private:
  std::vector<ObjectOccluder> occluders_;      ///< none: rays make shadows
  std::vector<Neighbourhood> neighbourhoods_;  ///< none: occluders or rays make shadows of the sky
  std::vector<float> direct_;
  LampPlaces places_;  ///< of the lamps
};

/// How a baked scene lights objects among it, wherever they stand: by its volume, and lamps by shadow rays.
/// Cells that a vertex does not see are left out of what is interpolated there, so that no light comes
/// through walls.
class ObjectLight : public ObjectScene {
 public:
  /// As ObjectScene; `volume` outlives it, too.
  ObjectLight(const CompiledScene& scene, const SceneParts& parts, const VolumeTransfer& volume,
              const GroupedLights* lights, const Device& device);

  /// Of an object where the scene has it.
  ObjectTransfer transferOf(const CompiledScene& scene, const VolumeObject& object);

  /// Of white convex bodies, one behind the other and of as many vertices each, that stand in the cells
  /// `voxels`: what these hold.
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
