// No lamp has a shadow map here. Where some have, shadows/mapped_lamps.glsl takes the place of this text.

// Returns the share of a lamp's light that reaches a point of a surface. `normal`: of its triangle, on the side that is seen.
float lampThroughMaps(Light light, vec3 point, vec3 normal) { return 1.0; }
