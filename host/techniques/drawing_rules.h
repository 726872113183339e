#pragma once

#include <compare>
#include <string_view>

namespace prelight {

/// Where the light comes from that a surface scatters diffusely: the shader text that takes the place of
/// ambient.glsl, which says what such a text answers. A technique may define further ones in its folder.
struct Ambient {
  std::string_view file;
  bool knowsLightAlone = false;  ///< and not how much of the sky is open

  auto operator<=>(const Ambient&) const = default;

  static const Ambient Open;             ///< the sky around the normal
  static const Ambient Transferred;      ///< the transferred radiance
  static const Ambient EncodedMap;       ///< the light of a light map in an encoding
  static const Ambient EncodedVertices;  ///< the light of vertices in an encoding
  static const Ambient Screen;           ///< the sky around the bent normal, as open as the picture shows
};
inline constexpr Ambient Ambient::Open{"ambient.glsl"};
inline constexpr Ambient Ambient::Transferred{"transferred_ambient.glsl", true};
inline constexpr Ambient Ambient::EncodedMap{"encoded_map_ambient.glsl", true};
inline constexpr Ambient Ambient::EncodedVertices{"encoded_vertices_ambient.glsl", true};
inline constexpr Ambient Ambient::Screen{"screen_ambient.glsl"};

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
