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

/// The best shading that a bake carries.
Shading carriedShading(const Bake& bake);

}  // namespace prelight::viewer
