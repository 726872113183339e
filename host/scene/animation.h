#pragma once

#include "prelight/scene.h"

namespace prelight {

/// Returns how many numbers a property has: 1 to 4.
int numbersOf(AnimatedProperty property);

/// Returns a property of one of the scene's materials, lights or cameras; unused components are 0.
glm::vec4 propertyOf(Scene& scene, AnimatedProperty property, std::size_t object);

/// Sets a property, clamped to the range that files permit.
void setProperty(Scene& scene, AnimatedProperty property, std::size_t object, const glm::vec4& value);

/// Sets materials, lights and cameras to an animation's values at a time. Properties that only other
/// animations change return to their initial values.
void setProperties(Scene& scene, const Animation& played, double seconds);

/// Returns true when an animation changes a property on which a bake of the surfaces depends.
bool changesSurfaces(const Animation& animation);

}  // namespace prelight
