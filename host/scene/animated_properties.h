#pragma once

#include "prelight/scene.h"

namespace prelight {

/// Numbers of a property: 1 to 4.
int numbersOf(AnimatedProperty property);

/// A property of one of the scene's materials, lights or cameras; numbers beyond its own are 0.
glm::vec4 propertyOf(Scene& scene, AnimatedProperty property, std::size_t object);

/// Sets it, kept within what files may say of it.
void setProperty(Scene& scene, AnimatedProperty property, std::size_t object, const glm::vec4& value);

/// Gives materials, lights and cameras what an animation says at a time; what other animations would change
/// rests.
void setProperties(Scene& scene, const Animation& played, double seconds);

/// Whether an animation changes what a bake of the surfaces depends on.
bool changesSurfaces(const Animation& animation);

}  // namespace prelight
