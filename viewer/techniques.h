#pragma once

#include <compare>
#include <cstdint>
#include <memory>

#include "viewer/drawn_transfer.h"
#include "viewer/render.h"

namespace prelight::viewer {

/// Where the light comes from that a surface scatters diffusely; numbers of shaders/frame.glsl.
enum class Ambient : int {
  Open = 0,         ///< the sky around the normal
  Accessible = 1,   ///< the sky around the bent normal, occluded
  Transferred = 2,  ///< the transferred radiance
  Cone = 4,  ///< the sky through the cone about the bent normal, which shadows lights and reflections, too
  LightMap = 3,         ///< the irradiance of a light map
  EncodedMap = 5,       ///< its light in an encoding
  EncodedVertices = 6,  ///< that of vertices
  Screen = 7,           ///< as Accessible, from OcclusionPass
  ScreenLight = 8,      ///< the sky and lamps that OcclusionPass finds with Ssdo
  ScreenBounce = 10,    ///< the same, and what surfaces send on
  Sender = 9,           ///< as ScreenLight, of what sends it on: nothing but that
  VirtualLights = 11,   ///< that of InstantRadiosityLighting
  Horizons = 12,        ///< the transferred sky above horizons, which shadow lights and reflections, too
  ObjectCube = 13,      ///< that of ObjectCubes, and the transferred radiance
};

/// How lights and the sky are reflected; numbers of shaders/frame.glsl.
enum class Reflection : int {
  Everywhere = 0,  ///< lights off all surfaces, without shadows; the sky off metals and glass
  Metals = 1,      ///< both off metals and glass only: exit radiance of others is albedo x transferred light
  Transfer = 2,    ///< through glossy transfer; lights that it does not hold, without shadows
};

/// Which lights come through the transfer; numbers of shaders/frame.glsl.
enum class Through : int { None = 0, FarLights = 1, AllLights = 2 };

/// How a shading is drawn.
struct DrawingRules {
  Ambient ambient = Ambient::Open;
  Reflection reflection = Reflection::Everywhere;
  Through through = Through::None;

  auto operator<=>(const DrawingRules&) const = default;
};

/// The inputs' encoding is that of light which the bake holds for this shading, so that it draws that.
bool drawsEncoding(Shading shading, const RenderInputs& inputs);

DrawingRules rulesOf(Shading shading, const RenderInputs& inputs);

/// Whether objects of the inputs are lit by cube maps in a shading: of those that know all the scene's light.
bool lightsByCubes(Shading shading, const RenderInputs& inputs);

/// The same for them: lamps light them from where each point is.
DrawingRules rulesOfObjects(DrawingRules scene);

/// Throws Error when something in the bake does not fit the scene or cannot be drawn.
void checkBake(const Bake& bake, const CompiledScene& scene);

/// Throws Error when the light of global illumination does not fit the scene.
void checkGlobalIllumination(const GlobalIllumination& globalIllumination, const CompiledScene& scene);

/// Uploads what the shading needs of a bake that carries it; nullptr where nothing of it is in a bake.
std::unique_ptr<DrawnTransfer> makeDrawnTransfer(Shading shading, const RenderInputs& inputs, Lobe lobe);

}  // namespace prelight::viewer
