// Light of objects that nothing was baked for, by the cube maps of viewer/cubes/object_cubes.h; needs sky.glsl, surroundings.glsl and
// lights.glsl.
#include "lamp_reach.glsl"
uniform sampler2D objectLight;  // [cube][i], SH of the radiance that arrives

// Returns the irradiance of a surface with unit normal n, over pi.
vec3 objectIrradiance(vec3 n) {
  vec4 c[9];
  for (int i = 0; i < 9; ++i) c[i] = texelFetch(objectLight, ivec2(i, cube), 0) * (i == 0 ? 1.0 : i < 4 ? 2.0 / 3.0 : 0.25);
  return max(harmonicsAround(c, n, vec2(1.0)), vec3(0.0));
}
