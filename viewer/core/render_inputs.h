#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "photon/caustic_light.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "prelight/scene.h"
#include "relight/vertex_lights.h"
#include "shared/photon_types.h"
#include "viewer/core/shading.h"

namespace prelight {
class Device;
struct Encoding;
struct GlobalIllumination;
class LiveLight;
struct VirtualLightSet;
}  // namespace prelight

namespace prelight::viewer {

/// Photons that are drawn as caustics, and how they are filtered. `photons` outlive what refers to them.
struct Caustics {
  std::span<const device::Photon> photons;
  CausticFilter filter;
  bool skipCells = true;  ///< false: filters cells without photons, too, to measure what that costs
};

/// Balls that show what a volume holds (host/relight/object_light.h).
struct DrawnProbes {
  int node = 0;               ///< that they are
  std::uint32_t surface = 0;  ///< material that is theirs alone
};

/// The scene and the light that are drawn. The referents outlive the call (or the window).
struct RenderInputs {
  const Scene& scene;
  const CompiledScene& compiled;  ///< of `scene`
  const Bake* bake = nullptr;     ///< of `compiled`; nullptr: none, enough for Phong
  const Environment* environment =
      nullptr;                         ///< nullptr: no sky, or a neutral one when nothing else gives light
  const Device* device = nullptr;      ///< relights wavelet and glossy transfer; nullptr: the host does
  const Caustics* caustics = nullptr;  ///< light of these photons is added to every shading; nullptr: none
  const GlobalIllumination* globalIllumination =
      nullptr;  ///< full shading needs it, and adds its caustics; nullptr: not offered
  /// Normal textures turn lights, reflections, and baked light that holds directions. False: surfaces are
  /// even.
  bool normalTextures = true;
  const Encoding* encoding =
      nullptr;  ///< lightmap and radiosity shading draw light in it, where the bake holds some; nullptr: none
  /// A bake of the pose that is shown: its transfer replaces that of `bake`, which is of another pose;
  /// nullptr: none.
  const Bake* posed = nullptr;

  std::optional<DrawnProbes> probes = {};          ///< none: the scene has no such balls
  const VirtualLightSet* virtualLights = nullptr;  ///< instant shading needs it; nullptr: not offered
  /// Objects whose vertices have nothing baked but for direct light, lit by ObjectCubes.
  std::span<const VertexRange> cubeLit = {};
  /// [vertex of theirs], what they leave of an even light from all around, and reflect of it onto themselves;
  /// none: all of it.
  std::span<const glm::vec3> cubeOpenness = {};
  /// Light of `globalIllumination` while it follows a moving scene, whose state debug views show; nullptr: it
  /// does not.
  const LiveLight* live = nullptr;

  /// Returns these inputs with another bake.
  RenderInputs with(const Bake* chosen) const {
    RenderInputs chosenInputs = *this;
    chosenInputs.bake = chosen;
    return chosenInputs;
  }

  /// Returns these inputs for a scene whose objects have moved.
  RenderInputs movedTo(const Scene& movedScene, const CompiledScene& moved) const {
    return {movedScene,
            moved,
            bake,
            environment,
            device,
            caustics,
            globalIllumination,
            normalTextures,
            encoding,
            posed,
            probes,
            virtualLights,
            cubeLit,
            cubeOpenness,
            live};
  }
};

/// Light of a shading that was found while it is drawn; what is left out stays as it was.
struct FoundLight {
  std::span<const glm::vec3> irradiance = {};  ///< W/m2, [vertex]
  std::span<const float> indirect = {};        ///< W/m2, [y][x][channel 3] of the inputs' light map
  const Caustics* caustics = nullptr;
  const VirtualLightSet* virtualLights = nullptr;
};

/// The bake that a shading is drawn from. Near lamps and light maps belong to the bake's first pose only.
const Bake* bakeOf(Shading shading, const RenderInputs& inputs);

/// Its rules of drawing; where the bake holds light in the inputs' encoding for it, those of that light.
DrawingRules rulesOf(Shading shading, const RenderInputs& inputs);

}  // namespace prelight::viewer
