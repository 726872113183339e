#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "prelight/scene.h"
#include "viewer/core/occluder_options.h"
#include "viewer/core/occlusion_options.h"
#include "viewer/core/shading.h"

namespace prelight::viewer {

/// The shape of glossy reflection in glossy shading, about the mirrored view.
enum class Lobe {
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
enum class AoCorrection {
  None,
  Interreflection,  ///< accessibility k becomes k / (1 - albedo (1 - k)), a channel (Eq. 11.13)
  Cubic,            ///< a cubic of k and the albedo, fitted to traced scenes (Jimenez et al. 2016)
};

/// The directions over which the sky is averaged for ambient occlusion whose bent normal is known (Real-Time
/// Rendering, 4th edition, 11.3.7).
enum class AoFilter {
  Cone,    ///< the cosine within the cone about the bent normal that lets through the accessibility
  Cosine,  ///< all of the cosine about the bent normal
};

constexpr double defaultHorizonSoftness = 0.035;  ///< 2 degrees

/// A factor for the colour of the light groups with a name.
struct GroupFactor {
  std::string name;
  glm::vec3 factor{1.0f};
};

/// Options of how shadings draw, which may differ from one picture of a scene to the next.
/// viewer/options/shading_options.cpp has a row for each.
struct ShadingOptions {
  std::size_t haarTerms = 0;  ///< coefficients that a light keeps in wavelet shading; 0: all
  AoCorrection aoCorrection = AoCorrection::None;
  AoFilter aoFilter = AoFilter::Cone;
  double horizonSoftness = defaultHorizonSoftness;  ///< of horizons shading: angular radius of lamps
                                                    ///< without a size, radians; 0: hard shadows
  ScreenOcclusionOptions screenOcclusion;           ///< of screen shading
  OccluderOptions occluders;                        ///< of vo shading

  bool operator==(const ShadingOptions&) const = default;
};

/// Options of a picture.
struct RenderOptions : ShadingOptions {
  Shading shading = Shading::Phong;
  int width = 0;              ///< pixels; 0: from the height and the camera's aspect (16:9 when it has none)
  int height = 720;           ///< pixels, 1..32768
  std::optional<int> camera;  ///< into Scene::cameras; none: the first, or frameCamera when there is none
  double skyRotation = 0.0;   ///< radians, turns the sky counter-clockwise about +Y seen from above
  std::optional<std::vector<Light>> lights;  ///< replaces the scene's punctual lights
  bool emitters = true;                      ///< emissive triangles light the scene
  bool windowLights = true;         ///< damps the SH bands of delta lights against ringing (see lighting.h)
  Lobe lobe = Lobe::Ggx;            ///< of glossy shading, and of lights in Phong's
  std::vector<GroupFactor> groups;  ///< of lights shading; those not named shine as in the file
  bool layersOfFrames = false;      ///< sequences have the layers of each picture
  int samplesPerAxis = 2;           ///< supersampling: this squared per pixel, box filtered; 1..8
};

}  // namespace prelight::viewer
