#pragma once

#include <compare>
#include <string_view>

namespace prelight {

/// Where the light comes from that a surface scatters diffusely. Pages know these numbers.
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

/// Its constant in shaders; empty for a number that no rule has.
constexpr std::string_view nameOf(Ambient rule) {
  switch (rule) {
    case Ambient::Open:
      return "ambientOpen";
    case Ambient::Accessible:
      return "ambientAccessible";
    case Ambient::Transferred:
      return "ambientTransferred";
    case Ambient::LightMap:
      return "ambientLightMap";
    case Ambient::Cone:
      return "ambientCone";
    case Ambient::EncodedMap:
      return "ambientEncodedMap";
    case Ambient::EncodedVertices:
      return "ambientEncodedVertices";
    case Ambient::Screen:
      return "ambientScreen";
    case Ambient::ScreenLight:
      return "ambientScreenLight";
    case Ambient::Sender:
      return "ambientSender";
    case Ambient::ScreenBounce:
      return "ambientScreenBounce";
    case Ambient::VirtualLights:
      return "ambientVirtualLights";
    case Ambient::Horizons:
      return "ambientHorizons";
    case Ambient::ObjectCube:
      return "ambientObjectCube";
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
