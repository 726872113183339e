// Shadows of lamps on what has a cube map around it; needs surroundings.glsl and lights.glsl.
uniform float cubeReach;  // m, of the scene

// Lamps lie on or before what the map sees there: of a texel, whose distances are mixed with its neighbours'.
const float atTheLamp = 0.9;
const int lampSteps = 6;  // on the way to a lamp, closer together where they lie near it and their directions differ

// Whether nothing that the map sees stands between a point of the object or node and a lamp.
bool reachesNode(Light light, vec3 point) {
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
