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

/// A row of Table 7.1 of [1]: its scene `shapes` of 5 013 vertices, 1 light, 10 000 rays, on a machine of
/// 2013.
struct ThesisRow {
  double firstPass;   ///< s, visibility
  double secondPass;  ///< s, what light does next; 0: there is none
  double frames;      ///< a second
  double megabytes;
};

/// Kinds of scenes that a technique is compared on; a set is their sum.
namespace compared {
constexpr unsigned lamps = 1;       ///< point lights outside the scene
constexpr unsigned sky = 2;         ///< nothing but a sky
constexpr unsigned mirrors = 4;     ///< things that mirror one another
constexpr unsigned room = 8;        ///< closed, by a lamp of its own
constexpr unsigned areaLamps = 16;  ///< area lights within
constexpr unsigned curve = 32;      ///< frames a second by lights
constexpr unsigned volume = 64;     ///< an object was put in that was not baked with it
constexpr unsigned open = lamps | sky;
}  // namespace compared

/// Segments of the paths of light that a technique claims to show, from the camera to the light.
namespace claims {
constexpr int directLight = 2;
constexpr int oneBounce = 3;
constexpr int allLight = 16;  ///< as the reference's paths
}  // namespace claims

/// A way to light a scene that is compared with others.
struct Technique {
  std::string name;
  viewer::RenderOptions render;  ///< shading and its options; the picture's size and lights are left to the
                                 ///< comparison
  BakeRequest request;           ///< bake of this technique alone; rays are left to the comparison
  unsigned scenes = 0;           ///< kinds that it is compared on
  int claim = claims::allLight;
  std::optional<ThesisRow> thesis = {};
};

/// Techniques of diffuse interreflection (DD), cheapest first, then those with specular terms (DS: diffuse
/// from specular, SS: specular from specular). Orders of SH and CH up to `order`, wavelets on faces of
/// `haarSize` texels.
std::vector<Technique> comparedTechniques(int order, int haarSize);

/// The techniques that are compared on a kind of scene.
std::vector<Technique> techniquesOn(unsigned kind, const std::vector<Technique>& all);

/// The technique shows light that surfaces mirror to one another, so that only shiny scenes tell it from
/// others.
bool showsMirrors(const Technique& technique);

/// False where a bake of its request lacks what it shows: specular vectors of occluders in a scene that
/// mirrors nothing.
bool canShow(const Technique& technique, const Bake& bake);

}  // namespace prelight::benchmarks
