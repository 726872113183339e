#pragma once

#include <span>
#include <string>
#include <string_view>

#include "techniques/shading.h"

namespace prelight::viewer {

using prelight::Shading;
using prelight::shadingCount;
using prelight::ShadingInfo;
using prelight::shadingName;

/// All shadings, in the order of the enumeration. The list of them is viewer/techniques/registry.
std::span<const ShadingInfo> shadings();
const ShadingInfo& infoOf(Shading shading);

/// All shadings, those that show most first.
std::span<const Shading> shadingsByPreference();

inline bool showsAllLight(Shading shading) { return infoOf(shading).traits.allLight; }
inline bool showsBakedLight(Shading shading) { return infoOf(shading).traits.bakedLight; }

/// "phong, ao, sh, ...".
std::string shadingNames();

/// Throws UsageError naming the known ones.
Shading parseShading(std::string_view name);

/// The light of a picture, as far as its best shading depends on it.
struct LightOfPicture {
  bool sky = true;
  bool outside = false;  ///< lamps outside of the scene
  bool inside = false;   ///< lamps or emissive surfaces within it
  bool asBaked = true;   ///< lights, sky and objects are those that the file's bake was made with
};

/// A shading that a bake carries, and the relMSE that its pictures are expected to have.
struct CarriedShading {
  Shading shading = Shading::Phong;
  float error = 1.0f;
};

/// The shading of least expected error of those that a bake carries; Phong where it carries none.
CarriedShading carriedShading(const Bake& bake, const LightOfPicture& light);

}  // namespace prelight::viewer
