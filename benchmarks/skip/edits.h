#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "benchmarks/skip/setting.h"

/// Changes of built-in scenes that bring a feature in or take it out.
namespace prelight::benchmarks::skip {

/// A built-in scene as its file has it.
Scene builtin(const std::string& name);

/// AO and SH of order 3 of a built-in scene.
Setting transferOf(const std::string& scene, const Effort& effort);

/// A light map of a built-in scene.
Setting lightMapOf(const std::string& scene, const Effort& effort);

/// Irradiance by radiosity of a built-in scene.
Setting radiosityOf(const std::string& scene, const Effort& effort);

/// A picture of a built-in scene.
Setting pictureOf(const std::string& scene, PictureMethod method, const Effort& effort);

/// What a change makes of a material.
using MaterialEdit = void (*)(Material&);

/// Needed: changes every material that a triangle has, but lights'. Unneeded: adds such a material, which no
/// triangle has, to a scene that stays as it is.
void editMaterials(Scene& scene, Presence presence, MaterialEdit edit);

/// Adds a texture of a few colours (of one, where `flat`), all of them opaque, and texture coordinates
/// where there are none; its index.
int addTexture(Scene& scene, bool flat);

/// A point light below the ceiling of `cornell` and of scenes in the same room.
Light lightInside(const glm::vec3& intensity);

void takeLightsAway(Scene& scene);
void blacken(Scene& scene);  ///< every material: nothing is reflected

std::shared_ptr<const Environment> skyOf(float radiance);

}  // namespace prelight::benchmarks::skip
