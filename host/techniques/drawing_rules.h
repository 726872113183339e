#pragma once

#include <compare>
#include <string_view>

namespace prelight {

/// Where the light comes from that a surface scatters diffusely.
enum class Ambient : int {
  Open,         ///< the sky around the normal
  Accessible,   ///< the sky around the bent normal, occluded
  Transferred,  ///< the transferred radiance
  LightMap,     ///< the irradiance of a light map
  Cone,         ///< the sky through the cone about the bent normal, which shadows lights and reflections, too
  EncodedMap,   ///< the light of a light map in an encoding
  EncodedVertices,  ///< the light of vertices in an encoding
  Screen,           ///< as Accessible, from OcclusionPass
  ScreenLight,      ///< the sky and lamps that OcclusionPass finds with Ssdo
  Sender,           ///< as ScreenLight, of what sends it on: nothing but that
  ScreenBounce,     ///< as ScreenLight, and what surfaces send on
  VirtualLights,    ///< that of InstantRadiosityLighting
  Horizons,         ///< the transferred sky above horizons, which shadow lights and reflections, too
  ObjectCube,       ///< that of ObjectCubes, and the transferred radiance
  Photons,          ///< the light map of photons
};

/// Its shader text, which takes the place of ambient.glsl.
constexpr std::string_view ambientFile(Ambient rule) {
  switch (rule) {
    case Ambient::Open:
      return "ambient.glsl";
    case Ambient::Accessible:
      return "accessible_ambient.glsl";
    case Ambient::Transferred:
      return "transferred_ambient.glsl";
    case Ambient::LightMap:
      return "light_map_ambient.glsl";
    case Ambient::Cone:
      return "cone_ambient.glsl";
    case Ambient::EncodedMap:
      return "encoded_map_ambient.glsl";
    case Ambient::EncodedVertices:
      return "encoded_vertices_ambient.glsl";
    case Ambient::Screen:
      return "screen_ambient.glsl";
    case Ambient::ScreenLight:
      return "screen_light_ambient.glsl";
    case Ambient::Sender:
      return "screen_sender_ambient.glsl";
    case Ambient::ScreenBounce:
      return "screen_bounce_ambient.glsl";
    case Ambient::VirtualLights:
      return "indirect_lights.glsl";
    case Ambient::Horizons:
      return "horizons_ambient.glsl";
    case Ambient::ObjectCube:
      return "object_ambient.glsl";
    case Ambient::Photons:
      return "indirect_map.glsl";
  }
  return {};
}

/// How lights and the sky are reflected.
enum class Reflection : int {
  Everywhere = 0,  ///< lights off all surfaces, without shadows; the sky off metals and glass
  Metals = 1,      ///< both off metals and glass only: exit radiance of others is albedo x transferred light
  Transfer = 2,    ///< through glossy transfer; lights that it does not hold, without shadows
};

/// Its constant in shaders; empty for a number that no rule has.
constexpr std::string_view nameOf(Reflection rule) {
  switch (rule) {
    case Reflection::Everywhere:
      return "reflectionEverywhere";
    case Reflection::Metals:
      return "reflectionOffMetals";
    case Reflection::Transfer:
      return "reflectionThroughTransfer";
  }
  return {};
}

/// Which lights come through the transfer.
enum class Through : int { None = 0, FarLights = 1, AllLights = 2 };

/// Its constant in shaders; empty for a number that no rule has.
constexpr std::string_view nameOf(Through rule) {
  switch (rule) {
    case Through::None:
      return "throughNone";
    case Through::FarLights:
      return "throughFarLights";
    case Through::AllLights:
      return "throughAllLights";
  }
  return {};
}

/// How a shading is drawn.
struct DrawingRules {
  Ambient ambient = Ambient::Open;
  Reflection reflection = Reflection::Everywhere;
  Through through = Through::None;

  auto operator<=>(const DrawingRules&) const = default;
};

/// Rules of what shows the light that its transfer lets through.
constexpr DrawingRules throughTransfer = {Ambient::Transferred, Reflection::Metals, Through::FarLights};

}  // namespace prelight
