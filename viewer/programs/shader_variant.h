#pragma once

#include <compare>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "techniques/drawing_rules.h"
#include "viewer/lights/lighting.h"

namespace prelight::viewer {

struct Surface;

/// Something that a surface, its light or its picture may have. A program has code only for its features.
enum class Feature : int {
  BaseColorTexture,
  MetallicRoughnessTexture,
  EmissiveTexture,
  NormalTexture,
  TransmissionTexture,
  SpecularTextures,
  Emission,
  Cutouts,   ///< fragments are left out by their alpha
  Blending,  ///< what lies behind shows
  Unlit,
  Translucency,  ///< light comes through diffusely
  Gloss,         ///< metal, glass or further lobes: the sky is reflected
  Glass,
  RoughGlass,
  Layer,          ///< a dielectric reflects on top of what is diffuse
  FurtherLobes,   ///< it is not plain: the material says more of what reflects than metalness and roughness
  TopLayers,      ///< a clear coat or a sheen over all that
  LayerTextures,  ///< those have textures
  Anisotropy,     ///< rough reflections are wider one way
  Film,           ///< a thin film colours them
  Dispersion,     ///< glass refracts by wavelength
  Surroundings,   ///< what lies around is reflected
  LocalReflections,  ///< what lies around is reflected in lobes of any width
  Measured,          ///< it reflects as was measured
  VertexColors,
  Charts,  ///< transfer of light maps beside that of vertices
  Caustics,
  SkyLight,  ///< a sky shines
  SkyMap,    ///< one that is not alike everywhere
  DirectionalLights,
  PointLights,
  SpotLights,
  ProfiledLights,  ///< point lights whose intensity varies with direction
  EmitterLights,
  CookieLights,  ///< spot lights that project a picture
  AreaLights,
  NearLamps,   ///< lights have shadows of a NearLampPass
  ShadowMaps,  ///< lights have shadows of a ShadowMapPass
  Count,       ///< their number, no feature
};

constexpr int featureCount = static_cast<int>(Feature::Count);
static_assert(featureCount <= 64, "Features holds 64 bits");

class Features {
 public:
  constexpr Features() = default;
  constexpr Features(std::initializer_list<Feature> features) {
    for (const Feature feature : features) add(feature);
  }
  static constexpr Features all() {
    Features features;
    features.bits_ = (std::uint64_t{1} << featureCount) - 1;
    return features;
  }

  constexpr void add(Feature feature, bool present = true) {
    if (present) bits_ |= std::uint64_t{1} << static_cast<int>(feature);
  }
  constexpr void remove(Feature feature) { bits_ &= ~(std::uint64_t{1} << static_cast<int>(feature)); }
  constexpr bool has(Feature feature) const { return (bits_ >> static_cast<int>(feature) & 1) != 0; }
  constexpr Features operator|(Features other) const {
    other.bits_ |= bits_;
    return other;
  }
  constexpr Features operator&(Features other) const {
    other.bits_ &= bits_;
    return other;
  }
  constexpr Features operator~() const {
    Features others;
    others.bits_ = all().bits_ & ~bits_;
    return others;
  }
  constexpr auto operator<=>(const Features&) const = default;

 private:
  std::uint64_t bits_ = 0;
};

/// Lights that a program knows the number of, as they are few: what is read of a light of a known number is
/// read once, not for every pixel.
struct LightCounts {
  static constexpr int many = -1;
  static constexpr int mostLamps = 4, mostSamples = 8;

  int lamps = many;    ///< lights that are not samples
  int samples = many;  ///< of emissive surfaces; known where lamps are

  auto operator<=>(const LightCounts&) const = default;
};

LightCounts fewLights(std::span<const ShadedLight> lights);

/// The constants that a program of surfaces is compiled for. The pictures of two that both have all that is
/// needed are the same.
struct ShaderVariant {
  DrawingRules rules;
  int aoCorrection = 0;     ///< AoCorrection of render.h
  int aoFilter = 0;         ///< AoFilter of render.h
  bool phongLobe = false;   ///< lights are reflected by a power of the cosine
  bool showsParts = false;  ///< its parts have factors (viewer/core/layer_factors.h)
  LightCounts lights;
  Features features;

  auto operator<=>(const ShaderVariant&) const = default;
};

/// The constant of a feature in shaders; those of rules are theirs.
std::string_view nameOf(Feature feature);
using prelight::nameOf;

/// A variant for any surface, light and picture.
ShaderVariant variantOfAnySurface();

/// The text that stands for the include "variant.glsl": the constants that a program is compiled for, and
/// numbers of rules. Code of one constant stands behind an `if` of that alone, as WebGL counts textures in
/// all other code, of which it promises 16.
std::string textOf(const ShaderVariant& variant);

/// The features of a surface's material.
Features featuresOf(const Surface& surface);

/// Gives surfaces the features of others, too, that differ from them in what costs little beside many lights:
/// they share programs, of which software OpenGL takes seconds to compile one. Pictures stay the same.
std::vector<Features> sharedFeatures(std::span<const Features> surfaces);

}  // namespace prelight::viewer
