#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "prelight/techniques.h"

namespace prelight {

/// The shape of glossy reflection in glossy shading, about the mirrored view.
enum class Lobe : std::uint8_t {
  /// The microfacet reflection at normal incidence as a function of the angle to the mirrored direction,
  /// whatever the view, and as much of it as the split-sum reflectance of the view says: an open surface
  /// under an even sky reflects just that. A lobe sharper than the order can show is smoothed until, cut off
  /// there, it is nowhere negative: it would show rings in place of a reflection.
  Ggx,
  /// The modified Phong BRDF, F0 (n + 2) / (2 pi) cos^n, with n = 2 / roughness^4 - 2: exact but for the
  /// bands that are cut, however sharp it is.
  Phong,
};

/// Light that creases reflect into themselves, in ao and screen shading (Real-Time Rendering, 4th
/// edition, 11.3).
enum class AoCorrection : std::uint8_t {
  None,
  Interreflection,  ///< accessibility k becomes k / (1 - albedo (1 - k)), per channel (Eq. 11.13)
  Cubic,            ///< a cubic of k and the albedo, fitted to traced scenes (Jimenez et al. 2016)
};

/// The directions over which the sky is averaged for ambient occlusion whose bent normal is known (Real-Time
/// Rendering, 4th edition, 11.3.7).
enum class AoFilter : std::uint8_t {
  Cone,    ///< the cosine within the cone about the bent normal that lets through the accessibility
  Cosine,  ///< all of the cosine about the bent normal
};

/// Sources of the shadows of lamps, and of the lamps of skies, in shadings that do not show all light.
enum class LampShadows : std::uint8_t {
  Auto,   ///< what the shading's own data hold of a lamp, and shadow maps where they hold nothing
  Maps,   ///< shadow maps for all lamps; light that surfaces send on stays without that of lamps which maps
          ///< take over
  Baked,  ///< the shading's own data alone
};

/// A factor for the colour of the light groups with a name.
struct GroupFactor {
  std::string name;
  glm::vec3 factor{1.0f};
};

/// How what occludes a pixel is found: among the surfaces of the picture, or, by Disks and Fields, among all
/// of the scene. Ssdo finds which light arrives.
enum class OcclusionMethod : std::uint8_t { Ssao, Hbao, Gtao, Ssdo, Disks, Fields };

/// Options of screen shading: occlusion of what is seen in a picture, found while it is drawn.
struct ScreenOcclusionOptions {
  OcclusionMethod method = OcclusionMethod::Gtao;
  double radius = 0.0;       ///< m, what is farther occludes nothing; 0: a share of the scene's size
  int slices = 4;            ///< of Gtao and Ssdo, and pairs of directions of Hbao
  int steps = 8;             ///< of each side of a slice
  int samples = 32;          ///< of Ssao
  int layers = 2;            ///< of surfaces that Gtao and Ssdo look at: 1 or 2
  double thickness = 0.0;    ///< m, of what has no back in the second layer; of both
  double elementSize = 0.0;  ///< m, of the longest edge of an element of Disks; 0: a share of the radius
  double opening = 0.4;      ///< radius over distance of groups that Disks does not take apart
  int passes = 1;            ///< of Disks: all but the last find how open the backs of elements are
  int bounces = 1;           ///< of Ssdo: light that surfaces in the picture send on, 0 or 1 times
  int stride = 1;            ///< pixels from one that occlusion is looked for at to the next, each way
  int frames = 1;            ///< pictures with turned samples whose mean is shown
  int cells = 1 << 15;       ///< of the field of an object, about; of Fields
  int fieldRays = 128;       ///< of a cell, a power of two, 16 and more; of Fields
  bool filtered = true;      ///< pixels of one surface are averaged

  bool operator==(const ScreenOcclusionOptions&) const = default;
};

/// Formulas for the shadows of vector occluders.
enum class OccluderFormula : std::uint8_t {
  Soft,    ///< sums blobs of all occluders, and makes shadows by a threshold (docs/notes/occluders.md)
  Thesis,  ///< product of sin^(2 N F) (Sherif 2013, Eq. 7.2 and 7.3)
};

/// Models of reflections in occluders.
enum class MirrorFormula : std::uint8_t {
  /// Lobes of unit integral whose width follows from the mirror's size and curvature
  /// (docs/notes/occluders.md).
  Lobe,
  Thesis,  ///< powers of cosines and of form factors (Sherif 2013, listing A.2)
};

/// Reflection model of diffuse receivers.
enum class DiffuseReceiver : std::uint8_t { Lambert, OrenNayar };

/// Effects that vary over time (Sherif 2013, 7.3). All are periodic.
struct OccluderEffects {
  double waves = 0.0;        ///< >= 0: tangent of the largest angle by which occlusion and caustics are bent
  double length = 1.0;       ///< length of the longest wave, m
  double fire = 0.0;         ///< >= 0: share of the lights' strength that flickers
  double moment = 0.0;       ///< phase of the period, [0,1)
  double normalWaves = 0.0;  ///< >= 0: as `waves`, for the receivers' normals (Figure 1.4)

  bool operator==(const OccluderEffects&) const = default;
};

/// Parameters of shading with vector occluders.
struct OccluderShading {
  OccluderFormula formula = OccluderFormula::Soft;
  /// N_sh of Eq. 7.2, >= 0, for the thesis' formula only; the thesis shows 0.2 to 5.5.
  double shadowStrength = 2.0;
  double bleeding = 1.0;  ///< factor of colour bleeding from diffuse surfaces; negative values remove colour
  double causticStrength = 1.0;       ///< >= 0: factor of caustic light; N_c of Eq. 7.3
  double diffuseFromSpecular = 1.0;   ///< >= 0: factor of light that occluders mirror to diffuse receivers
  double specularFromSpecular = 1.0;  ///< >= 0: factor of light that occluders mirror to glossy receivers
  double specularExponent = 100.0;    ///< >= 1: cosine power of a flat, small mirror; in A.2 of all mirrors
  MirrorFormula mirrors = MirrorFormula::Lobe;
  DiffuseReceiver receiver = DiffuseReceiver::Lambert;
  OccluderEffects effects = {};

  bool operator==(const OccluderShading&) const = default;
};

constexpr int defaultSkyLights = 32;  ///< lights that represent a sky, as in the thesis' Figure 7.24
constexpr int mostSkyLights = 4096;   ///< upper limit of OccluderOptions::skyLights

/// Options of vo shading: how vector occluders are lit.
struct OccluderOptions {
  OccluderShading shading;           ///< its `effects.length` and `effects.moment` follow from the scene,
                                     ///< `waveLength` and `seconds`
  int skyLights = defaultSkyLights;  ///< directional lights that represent a sky, >= 1
  bool allHighlights = false;        ///< lights reflect off all surfaces, not only off metals and glass
  double waveLength = 0.0;           ///< of the longest wave, m; 0: half the scene's radius
  double seconds = 0.0;              ///< time of the effects

  bool operator==(const OccluderOptions&) const = default;
};

constexpr double defaultHorizonSoftness = 0.035;  ///< 2 degrees

/// Options of how shadings draw, which may differ from one picture of a scene to the next. Each belongs to
/// the shadings that it names and is ignored by the others.
struct ShadingOptions {
  LampShadows direct = LampShadows::Auto;           ///< all but full and instant
  std::size_t haarTerms = 0;                        ///< haar: coefficients that a light keeps; 0: all
  AoCorrection aoCorrection = AoCorrection::None;   ///< ao and screen
  AoFilter aoFilter = AoFilter::Cone;               ///< ao and screen
  double horizonSoftness = defaultHorizonSoftness;  ///< horizons: angular radius of lamps without a size,
                                                    ///< radians; 0: hard shadows
  ScreenOcclusionOptions screenOcclusion = {};      ///< screen
  OccluderOptions occluders = {};                   ///< vo

  bool operator==(const ShadingOptions&) const = default;
};

/// How the photons of indirect light are distributed.
enum class PhotonChoice : std::uint8_t {
  Power,       ///< by the power of lights
  Importance,  ///< by their importance for the picture, sampled by importons
};

/// Selects the texels of a light map at which indirect light is gathered, and the rays.
enum class GatherChoice : std::uint8_t {
  All,     ///< cosine-distributed rays from every texel
  Cache,   ///< rays from some texels, with interpolation along gradients in between
  Guided,  ///< rays from every texel, half of them in directions that photons came from
};

/// Options of full shading.
struct FullOptions {
  std::uint32_t samples = 8;  ///< per pixel, 1 to 64
  /// Photons that leave lights, for indirect light; none: 4 per texel of its map, 50,000 to 2 million.
  std::optional<std::uint64_t> photons = {};
  PhotonChoice photonsBy = PhotonChoice::Power;
  /// Photons that are emitted towards objects that make caustics; none: by the number of pixels.
  std::optional<std::uint64_t> causticPhotons = {};
  /// Approximate number of texels of the light map for indirect light; none: by the number of pixels.
  std::optional<std::uint32_t> texels = {};
  GatherChoice gather = GatherChoice::All;
  std::optional<std::uint32_t> gatherRays = {};  ///< per texel, a power of two; none: by the samples
  /// Draws with shadow maps and environment maps, as windows do, instead of tracing direct light and mirrors.
  bool rasterised = false;
};

/// Options of instant shading, whose indirect light comes from virtual lights.
struct InstantOptions {
  /// Approximate number of paths that leave lights; more where most of them make no virtual light.
  std::uint64_t paths = 64;
  std::uint32_t renewals = 8;  ///< most paths traced again per frame of a window; 0: all that have changed
  /// m; nearer places are lit as from this distance, and the missing light is added within it; 0: the radius
  /// of the disc that a virtual light represents
  double nearest = 0.0;
  int depth = 16;  ///< most segments of a path, camera to light
  std::uint64_t seed = 0;

  bool operator==(const InstantOptions&) const = default;
};

}  // namespace prelight
