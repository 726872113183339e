#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "benchmarks/suites/skip/setting.h"

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

/// A change of a material.
using MaterialEdit = void (*)(Material&);

/// Needed: changes every material that a triangle has, but lights'. Unneeded: adds such a material, which no
/// triangle has, to a scene that stays as it is.
void editMaterials(Scene& scene, Presence presence, MaterialEdit edit);

/// How a row says that editMaterials() leaves a feature not needed.
inline constexpr const char* ofNoTriangle = "of a material that no triangle has";

/// MaterialEdits.
void mirror(Material& material);
void glass(Material& material);
void translucent(Material& material);

/// Adds a texture of a few colours (of one, where `flat`), all of them opaque, and texture coordinates
/// where there are none; its index.
int addTexture(Scene& scene, bool flat);

/// Gives a texture (see addTexture()) to every material, or where it is not needed to one more, which no
/// triangle has.
void giveTexture(Scene& scene, Presence presence, TextureRef Material::*texture, bool flat);

/// Adds a point light below the ceiling of `cornell` and of scenes in the same room, black where it is not
/// needed.
void addLight(Scene& scene, Presence presence);

void takeLightsAway(Scene& scene);
void blacken(Scene& scene);  ///< every material: nothing is reflected

/// White, black where it is not needed, null where it is absent.
std::shared_ptr<const Environment> skyOf(Presence presence);

}  // namespace prelight::benchmarks::skip
