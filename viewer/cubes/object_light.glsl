// Light of objects that nothing was baked for, by the cube maps of viewer/cubes/object_cubes.h; needs sky.glsl, surroundings.glsl and
// lights.glsl.
uniform sampler2D objectLight;  // [cube][i], SH of the radiance that arrives
uniform float cubeReach;        // m, of the scene

// Returns the irradiance of a surface with unit normal n, over pi.
vec3 objectIrradiance(vec3 n) {
  vec4 c[9];
  for (int i = 0; i < 9; ++i) c[i] = texelFetch(objectLight, ivec2(i, cube), 0) * (i == 0 ? 1.0 : i < 4 ? 2.0 / 3.0 : 0.25);
  return max(harmonicsAround(c, n, vec2(1.0)), vec3(0.0));
}

// Lamps lie on or before what the map sees there: of a texel, whose distances are mixed with its neighbours'.
const float atTheLamp = 0.9;
const int lampSteps = 6;  // on the way to a lamp, closer together where they lie near the object and their directions differ

// Whether nothing that the map sees stands between a point of the object and a lamp.
bool reachesObject(Light light, vec3 point) {
  bool isDirection = hasDirectionalLights && kindOf(light) == kindDirectional;
  vec3 path = isDirection ? -cubeReach * light.directionArea.xyz : light.positionKind.xyz - point;
  vec3 from = point - cubeCenter;
  for (int k = 1; k <= lampSteps; ++k) {
    float share = float(k * k) / float(lampSteps * lampSteps);
    vec3 there = from + share * path;
    if (distanceSeen(surroundings, there) < atTheLamp * length(there)) return false;
  }
  return true;
}
