#pragma once

#include <optional>
#include <string>
#include <vector>

#include "prelight/bake.h"
#include "prelight/plan.h"
#include "viewer/frame/render.h"

// [1] Sherif, "Vector occluders: an empirical approximation for rendering global illumination effects in
// real-time", 2013.

namespace prelight::benchmarks {

/// A row of Table 7.1 of [1]: its scene `shapes` of 5 013 vertices with 1 light and 10 000 rays on a machine
/// of 2013.
struct ThesisRow {
  double firstPass;   ///< seconds of visibility
  double secondPass;  ///< seconds of interreflection; 0: none
  double frames;      ///< per second
  double megabytes;
};

/// Kinds of scenes on which a technique is compared. A set of kinds is their sum.
namespace compared {
constexpr unsigned lamps = 1;       ///< point lights outside the scene
constexpr unsigned sky = 2;         ///< a sky alone
constexpr unsigned mirrors = 4;     ///< objects that mirror one another
constexpr unsigned room = 8;        ///< a closed room with its own lamp
constexpr unsigned areaLamps = 16;  ///< area lights within the scene
constexpr unsigned curve = 32;      ///< frames per second by the number of lights
constexpr unsigned volume = 64;     ///< an object that was not baked with the scene
constexpr unsigned open = lamps | sky;
}  // namespace compared

/// Number of segments, from the camera to the light, of the light paths that a technique claims to show.
namespace claims {
constexpr int directLight = 2;
constexpr int oneBounce = 3;
constexpr int allLight = 16;  ///< like the reference's paths
}  // namespace claims

/// A way to light a scene, to be compared with others.
struct Technique {
  std::string name;
  viewer::RenderOptions render;  ///< shading and its options; the picture's size and lights are left to the
                                 ///< comparison
  BakeRequest request;           ///< bake of this technique alone; rays are left to the comparison
  unsigned scenes = 0;           ///< kinds of scenes on which it is compared
  int claim = claims::allLight;
  std::optional<ThesisRow> thesis = {};
};

/// Returns techniques of diffuse interreflection (DD), cheapest first, then those with specular terms (DS:
/// diffuse from specular, SS: specular from specular). Orders of SH and CH up to `order`, wavelets on faces
/// of `haarSize` texels.
std::vector<Technique> comparedTechniques(int order, int haarSize);

/// Returns the techniques that are compared on a kind of scene.
std::vector<Technique> techniquesOn(unsigned kind, const std::vector<Technique>& all);

/// Returns whether a technique shows light that surfaces mirror to one another; only shiny scenes tell it
/// from others.
bool showsMirrors(const Technique& technique);

/// Returns false if the bake lacks what the technique shows: specular vectors of occluders in a scene without
/// mirrors.
bool canShow(const Technique& technique, const Bake& bake);

}  // namespace prelight::benchmarks
