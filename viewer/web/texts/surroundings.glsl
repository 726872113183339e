// In place of what lies around a surface by cube maps, which pages have not: the sky alone. Needs sky.glsl.
vec3 surroundingRadiance(vec3 point, vec3 way, float roughness) { return skyRadiance(way, levelOfRoughness(roughness)); }
