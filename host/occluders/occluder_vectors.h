#pragma once

#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"

/// Which vectors of vector occluders a scene needs.
namespace prelight {

/// Mirrors light, or reflects it in a lobe that is narrow enough to show what is there: roughness of at most
/// 0.5. Factors count, textures do not.
bool isShiny(const CompiledMaterial& material);

/// Whether some triangle's material is shiny (isShiny) or glass (isGlass).
bool hasShine(const CompiledScene& scene);
bool hasGlass(const CompiledScene& scene);

/// Ascending: position, occlusion, diffuse normal and colour always; caustic and transmissive where there is
/// glass, specular normal and colour where there is shine.
std::vector<OccluderVector> neededVectors(const CompiledScene& scene);

/// How far light must be free of obstacles behind glass or a mirror to count, m. Infinite where light comes
/// from outside the scene. A quarter of the bounds' diagonal where a lamp or a punctual light lies inside: in
/// a room, nothing is free for longer.
double freeReach(const CompiledScene& scene);

}  // namespace prelight
