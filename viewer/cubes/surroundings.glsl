// Surroundings of a surface, from the cube maps of viewer/cubes/surroundings.h; needs sky.glsl.
uniform samplerCubeArray surroundings;  // [node] rgb: radiance, a: distance in m, far beyond the scene: the sky
uniform samplerCubeArray insides;       // [node] xyz: normal of the body's surface, w: distance in m
uniform int cube;                       // of the batch's node, or of one near it; -1: none, the sky is all around
uniform int isOwnCube;                  // 1: of the node itself
uniform vec3 cubeCenter;

const int steps = 12;
const int halvings = 5;
const int mostReflectionsWithin = 3;
const float beyondScene = 1e15;  // m

float distanceSeen(samplerCubeArray distances, vec3 way) { return textureLod(distances, vec4(way, float(cube)), 0.0).a; }

// Distance along a ray to the first place where it goes behind what the middle of the cube sees, in steps of one angle
// as the middle sees them. Where it does so at the edge of something it may come out again on the other side.
float distanceAlong(samplerCubeArray distances, vec3 from, vec3 way) {
  float start = dot(from, way);
  vec3 aside = from - start * way;  // from the middle to the ray where it is nearest
  float offset = length(aside);
  if (offset < 1e-4 * length(from)) return max(distanceSeen(distances, way) - start, 0.0);
  aside /= offset;
  float whole = atan(offset, start);
  float before = whole;
  bool inside = true;
  for (int i = 1; i <= steps; ++i) {
    float angle = whole * (1.0 - float(i) / float(steps));
    float seen = distanceSeen(distances, cos(angle) * way + sin(angle) * aside);
    bool nowInside = seen * sin(angle) > offset;
    if (seen >= beyondScene) nowInside = true;
    if (inside && !nowInside) {
      float near = before, far = angle;
      for (int k = 0; k < halvings; ++k) {
        float middle = 0.5 * (near + far);
        float there = distanceSeen(distances, cos(middle) * way + sin(middle) * aside);
        if (there >= beyondScene || there * sin(middle) > offset) near = middle;
        else far = middle;
      }
      float radius = distanceSeen(distances, cos(near) * way + sin(near) * aside);
      // Where the surface goes on, both distances are nearly the ray's.
      if (radius * sin(near) < 1.15 * offset) return max(offset / tan(near) - start, 0.0);
    }
    inside = nowInside;
    before = angle;
  }
  return inside ? 2.0 * beyondScene : max(distanceSeen(distances, way) - start, 0.0);
}

// Whether something stands between the cube's middle and a point of the node, so that it knows little of what that sees.
bool hiddenFromCube(vec3 point) {
  vec3 from = point - cubeCenter;
  return cube >= 0 && distanceSeen(surroundings, from) < 0.97 * length(from);
}

// Radiance that arrives at a point of the node from a direction, blurred as by a lobe of a roughness.
vec3 surroundingRadiance(vec3 point, vec3 way, float roughness) {
  if (cube < 0) return skyInLobe(way, spreadOfRoughness(roughness));
  vec3 from = point - cubeCenter;
  float along = distanceAlong(surroundings, from, way);
  vec3 seen = along >= beyondScene ? way : from + along * way;
  float texel = pi / 2.0 / float(textureSize(surroundings, 0).x);
  float level = roughness < 0.05 ? 0.0 : max(log2(1.2 * roughness * roughness / texel), 0.0);
  vec4 found = textureLod(surroundings, vec4(seen, float(cube)), level);
  // The map itself is sharper than the cube.
  return level == 0.0 && found.a >= beyondScene ? skyRadiance(way, 0.0) : found.rgb;
}

float texelOfCube() { return pi / 2.0 / float(textureSize(surroundings, 0).x); }

// Mean radiance of what a cone of a solid angle about the direction meets.
vec3 surroundingWithin(vec3 point, vec3 way, float solidAngle) {
  if (cube < 0) return skyRadiance(way, levelOfSolidAngle(solidAngle));
  vec3 from = point - cubeCenter;
  float along = distanceAlong(surroundings, from, way);
  bool isSky = along >= beyondScene;
  vec3 seen = isSky ? way : from + along * way;
  float spread = isSky ? 1.0 : along * along / max(dot(seen, seen), 1e-30);  // what is near is a small part of the middle's view
  float texel = texelOfCube();
  float level = max(0.5 * log2(max(solidAngle * spread, 1e-9) / (texel * texel)), 0.0);
  vec4 found = textureLod(surroundings, vec4(seen, float(cube)), level);
  return level == 0.0 && found.a >= beyondScene ? skyRadiance(way, levelOfSolidAngle(solidAngle)) : found.rgb;
}

// Radiance reflected by a lobe that is wider along one direction than across; needs anisotropy.glsl.
vec3 surroundingStretched(vec3 point, vec3 n, vec3 toEye, vec3 along, vec2 widths) {
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  float blur = stretchedBlur(widths);
  for (int k = 0; k < tilts; ++k) {
    vec3 way;
    float weight = tiltedWay(k, n, toEye, along, widths, way);
    if (weight <= 0.0) continue;
    sum += weight * surroundingRadiance(point, way, blur);
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : surroundingRadiance(point, reflect(-toEye, n), sqrt(widths.y));
}

// Follows a way within a body to where it meets its surface, of which it returns the outward normal.
vec3 leaveBody(inout vec3 point, vec3 way, vec3 absorption, inout vec3 passed) {
  float along = distanceAlong(insides, point - cubeCenter, way);
  point += along * way;
  passed *= exp(-absorption * along);
  vec3 n = texture(insides, vec4(point - cubeCenter, float(cube))).xyz;
  return dot(n, n) > 1e-6 ? normalize(n) : normalize(point - cubeCenter);
}

// Radiance that comes through a body of glass whose outward normal is n: where it leaves the body, or after reflections
// within. `passed`: share that the body lets through. Without a cube of its own it is straight to look through.
vec3 radianceThroughBody(vec3 point, vec3 n, vec3 toEye, float ior, vec3 absorption, out vec3 passed) {
  passed = vec3(1.0);
  if (cube < 0 || isOwnCube == 0) return surroundingRadiance(point, -toEye, 0.0);
  vec3 way = refract(-toEye, n, 1.0 / ior);
  for (int i = 0; i <= mostReflectionsWithin; ++i) {
    vec3 back = leaveBody(point, way, absorption, passed);
    if (dot(back, way) <= 0.0) break;
    vec3 leaving = refract(way, -back, ior);
    if (dot(leaving, leaving) > 0.0) return surroundingRadiance(point, leaving, 0.0);
    way = reflect(way, back);
  }
  return surroundingRadiance(point, way, 0.0);
}
