#pragma once

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "prelight/scene.h"

/// Checks of the promises that readers make about accepted input. The functions throw std::logic_error where
/// one does not hold.
namespace prelight::fuzz {

/// Requires of a compiled scene indices within their arrays and finite numbers, and of the scene that it was
/// compiled from images with as many texels as their size says.
void requireSound(const Scene& scene, const CompiledScene& compiled);

/// Requires finite numbers in every array that techniques compare.
void requireSound(const Bake& bake);

/// Requires radiance from 0 on for every texel.
void requireSound(const Environment& sky);

/// Requires a finite intensity, place and direction.
void requireSound(const Light& light);

void requireSound(const Image& image);

}  // namespace prelight::fuzz
