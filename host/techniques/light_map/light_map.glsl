// Light maps whose places belong to the corners of triangles; needs triangles.glsl.
#include "core/dialect.h"
#include "shared/walled_square.h"
uniform sampler2DArray lightMaps;       // radiance before albedo, or irradiance and, of 5 layers, SH of order 2
uniform TEXELS lightMapCorners;  // [face][3] texels from the upper left; x < 0: the face has none
uniform int frontFaces;                 // fronts of triangles, then their backs
uniform TEXELS lightMapWalls;  // [row][column] of lightMaps: walls to the right and below, as shares of the way there
uniform bool lightMapWalled;   // else there are none, and none is read

// Texels that a look-up meets.
struct LightMapPlace {
  ivec2 low;
  ivec2 high;
  vec2 share;    // of high
  bool whole;    // no wall parts them
  SquareWeights weights;  // where one does
};

vec3 lightMapLayer(LightMapPlace p, int layer) {
  vec3 lowLow = texelFetch(lightMaps, ivec3(p.low, layer), 0).rgb;
  vec3 highLow = texelFetch(lightMaps, ivec3(p.high.x, p.low.y, layer), 0).rgb;
  vec3 lowHigh = texelFetch(lightMaps, ivec3(p.low.x, p.high.y, layer), 0).rgb;
  vec3 highHigh = texelFetch(lightMaps, ivec3(p.high, layer), 0).rgb;
  // By hand, as textures round weights to 1/256.
  if (p.whole) return mix(mix(lowLow, highLow, p.share.x), mix(lowHigh, highHigh, p.share.x), p.share.y);
  return p.weights.leftTop * lowLow + p.weights.rightTop * highLow + p.weights.leftBottom * lowHigh +
         p.weights.rightBottom * highHigh;
}

// Looks up past walls with the darker of the two answers that they leave: by layer 0, which may be numbers of an encoding.
void keepToSide(inout LightMapPlace p) {
  int columns = textureSize(lightMaps, 0).x;
  vec2 first = FETCH(lightMapWalls, p.low.y * columns + p.low.x).xy;
  WalledSquare walls;
  walls.top = first.x;
  walls.left = first.y;
  walls.bottom = FETCH(lightMapWalls, p.high.y * columns + p.low.x).x;
  walls.right = FETCH(lightMapWalls, p.low.y * columns + p.high.x).y;
  if (!hasWalls(walls)) return;
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  p.whole = false;
  p.weights = walledWeights(walls, p.share.x, p.share.y, true);
  float wide = dot(abs(lightMapLayer(p, 0)), luminance);
  SquareWeights before = p.weights;
  p.weights = walledWeights(walls, p.share.x, p.share.y, false);
  if (wide < dot(abs(lightMapLayer(p, 0)), luminance)) p.weights = before;
}

// Finds the place of a point of a triangle's side; false where that has no place in the map.
bool findLightMapPlace(int triangle, bool front, vec3 point, out LightMapPlace found) {
  int face = 3 * (front ? triangle : frontFaces + triangle);
  vec2 first = FETCH(lightMapCorners, face).xy;
  if (first.x < 0.0) return false;
  ivec3 corners = ivec3(FETCH(triangleCorners, triangle).xyz);
  vec3 weights = max(weightsOfCorners(corners, point), vec3(0.0));
  weights /= weights.x + weights.y + weights.z;
  vec2 place = weights.x * first + weights.y * FETCH(lightMapCorners, face + 1).xy +
               weights.z * FETCH(lightMapCorners, face + 2).xy - 0.5;
  found.low = ivec2(floor(place));
  found.high = min(found.low + 1, textureSize(lightMaps, 0).xy - 1);
  found.share = place - vec2(found.low);
  found.whole = true;
  if (lightMapWalled) keepToSide(found);
  return true;
}

vec3 lightMapIrradiance(int triangle, bool front, vec3 point) {
  LightMapPlace place;
  return findLightMapPlace(triangle, front, point, place) ? lightMapLayer(place, 0) : vec3(0.0);
}

// Irradiance where a normal map turns the unit normal n to m: tests/support/mapped_irradiance.h, channels side by side.
vec3 mappedLightMapIrradiance(int triangle, bool front, vec3 point, vec3 n, vec3 m) {
  const float constant = 0.282094792;  // sqrt(1 / (4 pi))
  const float linear = 0.488602512;    // sqrt(3 / (4 pi))
  LightMapPlace place;
  if (!findLightMapPlace(triangle, front, point, place)) return vec3(0.0);
  vec3 irradiance = lightMapLayer(place, 0);
  if (textureSize(lightMaps, 0).z < 5) return irradiance;
  vec3 x = lightMapLayer(place, 4) / linear;
  vec3 y = lightMapLayer(place, 2) / linear;
  vec3 z = lightMapLayer(place, 3) / linear;
  vec3 missing = irradiance - (x * n.x + y * n.y + z * n.z);  // between texels the two would differ
  x += missing * n.x;
  y += missing * n.y;
  z += missing * n.z;
  vec3 squared = x * x + y * y + z * z;
  vec3 all = max(lightMapLayer(place, 1) / constant, sqrt(squared));
  vec3 b = 2.0 * all - irradiance;
  vec3 even = clamp((b - sqrt(max(b * b - 3.0 * (all * all - squared), vec3(0.0)))) / 3.0, vec3(0.0),
                    max(irradiance, vec3(0.0)));
  float cosine = dot(m, n);
  vec3 lamp = x * m.x + y * m.y + z * m.z - even * cosine;
  return 0.5 * even * (1.0 + cosine) + max(lamp, vec3(0.0));
}
