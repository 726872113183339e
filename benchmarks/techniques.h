#pragma once

#include <optional>
#include <string>
#include <vector>

#include "prelight/bake.h"
#include "prelight/plan.h"
#include "viewer/illumination.h"
#include "viewer/screen/occlusion_options.h"
#include "viewer/shading.h"

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

/// A way to light a scene that is compared with others.
struct Technique {
  std::string name;
  BakeRequest request;  ///< of it alone; rays are left to the comparison
  viewer::Shading shading = viewer::Shading::Phong;
  viewer::OccluderOptions occluders;
  bool specular = false;  ///< shows light that surfaces mirror to one another, so that only shiny scenes tell
                          ///< it from others
  std::optional<ThesisRow> thesis;
  viewer::ScreenOcclusionOptions screenOcclusion = {};
};

/// Techniques of diffuse interreflection (DD), cheapest first, then those with specular terms (DS: diffuse
/// from specular, SS: specular from specular). Orders of SH and CH up to `order`, wavelets on faces of
/// `haarSize` texels. Radiosity is among them where this version has such a shading.
std::vector<Technique> comparedTechniques(int order, int haarSize);

/// False where a bake of its request lacks what it shows: specular vectors of occluders in a scene that
/// mirrors nothing, or in a version that does not make them.
bool canShow(const Technique& technique, const Bake& bake);

}  // namespace prelight::benchmarks
