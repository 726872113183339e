#pragma once

#include <span>

#include "prelight/options.h"

/// Options of a bake that all techniques share; those of a technique lie in its folder.
namespace prelight {

/// Returns the options that say which light techniques carry.
std::span<const Option<BakeRequest>> lightOptions();

/// Returns the options that say what occludes, and how much work a bake may be.
std::span<const Option<BakeRequest>> castOptions();

}  // namespace prelight
