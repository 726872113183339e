#pragma once

#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"

/// Functions that determine which vectors of vector occluders a scene needs.
namespace prelight {

/// Returns whether a material mirrors light or reflects it in a lobe narrow enough to show reflected objects:
/// a roughness of at most 0.5. Factors count, textures do not.
bool isShiny(const CompiledMaterial& material);

/// Return whether some triangle's material is shiny (isShiny) or glass (isGlass).
bool hasShine(const CompiledScene& scene);
bool hasGlass(const CompiledScene& scene);

/// Returns the needed vectors, ascending: always position, occlusion, diffuse normal and colour; caustic and
/// transmissive if there is glass; specular normal and colour if there are shiny materials.
std::vector<OccluderVector> neededVectors(const CompiledScene& scene);

/// Returns the unobstructed distance, m, that light behind glass or in front of a mirror needs to count:
/// infinite if light comes from outside the scene, and a quarter of the bounds' diagonal if a lamp or a
/// punctual light is inside, as nothing is unobstructed for longer in a room.
double freeReach(const CompiledScene& scene);

}  // namespace prelight
