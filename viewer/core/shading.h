#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/text.h"
#include "prelight/bake.h"
#include "prelight/plan.h"

namespace prelight::viewer {

/// How light reaches a surface in the picture.
enum class Shading : std::uint8_t {
  Phong,               ///< direct light without shadows, ambient from the open sky
  Ao,                  ///< Phong with the ambient light occluded by the baked accessibility
  Sh,                  ///< light through the baked SH transfer, compressed or not
  Ch,                  ///< the same through CH transfer
  Haar,                ///< the same through wavelet transfer
  Glossy,              ///< diffuse and glossy reflection through transfer matrices
  Lights,              ///< the scene's own lights through light-group transfer, with shadows
  Vo,                  ///< lights anywhere with the shadows and the diffuse light of vector occluders
  Radiosity,           ///< the baked irradiance of the scene's own lights, with all diffuse bounces
  LightMap,            ///< the same from the texels of a light map
  Cones,               ///< sky, lights and reflections through the baked cone about the bent normal
  GlobalIllumination,  ///< all light: direct with shadow maps, indirect from a map, caustics, mirrors and
                       ///< glass
  Screen,              ///< Ao with an accessibility that is found in the picture itself, without a bake
  Horizons,            ///< sky, lights and reflections above the baked horizons
  Instant,             ///< direct light with shadow maps, indirect light of virtual lights with theirs
};

/// Name for the command line and files; empty for a number that no shading has.
constexpr std::string_view shadingName(Shading shading) {
  switch (shading) {
    case Shading::Phong:
      return "phong";
    case Shading::Ao:
      return "ao";
    case Shading::Sh:
      return "sh";
    case Shading::Ch:
      return "ch";
    case Shading::Haar:
      return "haar";
    case Shading::Glossy:
      return "glossy";
    case Shading::Lights:
      return "lights";
    case Shading::Vo:
      return "vo";
    case Shading::Radiosity:
      return "radiosity";
    case Shading::LightMap:
      return "lightmap";
    case Shading::Cones:
      return "cones";
    case Shading::GlobalIllumination:
      return "full";
    case Shading::Screen:
      return "screen";
    case Shading::Horizons:
      return "horizons";
    case Shading::Instant:
      return "instant";
  }
  return {};
}

constexpr int shadingCount = static_cast<int>(countNamed(shadingName));

/// Whether lights of every kind have shadow maps, and mirrors and glass show what lies around them.
constexpr bool showsAllLight(Shading shading) {
  return shading == Shading::GlobalIllumination || shading == Shading::Instant;
}

/// Whether a shading takes the sun out of a sky and shades it as a lamp: those that have the sky in few
/// bands, and shadows of lamps.
constexpr bool showsSunAsLamp(Shading shading) {
  return shading == Shading::Cones || shading == Shading::Horizons;
}

/// Whether a shading shows the light that arrived when it was baked, whatever shines now.
constexpr bool showsBakedLight(Shading shading) {
  return shading == Shading::Radiosity || shading == Shading::LightMap;
}

/// Describes a shading: its name and the baked data that it needs.
struct ShadingInfo {
  Shading shading;
  std::string_view summary;     ///< for lists of names
  std::string_view bakeOption;  ///< of `bake`, for what it needs; empty where it needs none
  bool (*carriedBy)(
      const Bake&);  ///< the bake has all that it needs; no bake has what those of showsAllLight do
  bool (*askedBy)(const BakeRequest&);  ///< the request names what it needs
  /// Asks for what it needs: as `asked` does, or by default.
  void (*addTo)(BakeRequest& request, const BakeRequest& asked);

  std::string_view name() const { return shadingName(shading); }
};

/// All shadings, in the order of the enumeration.
std::span<const ShadingInfo> shadings();
const ShadingInfo& infoOf(Shading shading);

/// "phong, ao, sh, ...".
std::string shadingNames();

/// Throws UsageError naming the known ones.
Shading parseShading(std::string_view name);

/// The best shading that a bake carries.
Shading carriedShading(const Bake& bake);

}  // namespace prelight::viewer
