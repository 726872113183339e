#include "transport/profile_funcs.cl"
// The lights; needs variant.glsl. Their maths is documented in viewer/lights/lighting.h.
#include "light_block.glsl"
uniform TEXELS lampTables;  // LampTables

#include "area_lights.glsl"
#include "cookies.glsl"

int kindOf(Light light) { return int(light.positionKind.w + 0.5); }
bool isFar(Light light) { return light.cone.z > 0.0 ? light.cone.z > 0.5 && light.cone.z < 1.5 : fract(-light.cone.z) > 0.1; }
bool isMapped(Light light) { return hasShadowMaps && light.cone.z < -0.5; }  // it has shadow maps
int shadowOf(Light light) { return int(light.cone.z + 0.5) - 2; }  // of NearLampPass; < 0: none

bool isArea(Light light) { return hasAreaLights && kindOf(light) == kindArea; }
// A lamp of a sky, which metals and glass reflect with the map.
bool isOfSky(Light light) { return hasDirectionalLights && kindOf(light) == kindDirectional && light.cone.w > 0.5; }
int entryOf(Light light) { return int(light.cone.y + 0.5); }

AreaShape shapeFrom(Light light, vec3 point) {
  return seenShape(light.positionKind.xyz, light.directionArea.xyz, entryOf(light), point);
}

// Irradiance on a surface at `point` that faces the light, and the unit direction to the light.
vec3 perpendicularIrradiance(Light light, vec3 point, out vec3 toLight) {
  int kind = kindOf(light);
  if (hasDirectionalLights && kind == kindDirectional) {
    toLight = -light.directionArea.xyz;
    return light.intensityRange.rgb;
  }
  vec3 path = light.positionKind.xyz - point;
  float distance2 = dot(path, path);
  toLight = path * inversesqrt(max(distance2, 1e-30));
  if (hasAreaLights) {
    if (isArea(light)) {
      vec3 sum = shapeVector(shapeFrom(light, point), toLight);
      float strength = length(sum);
      if (strength > 0.0) toLight = sum / strength;
      return light.intensityRange.rgb * strength;
    }
  }
  float cosine = -dot(light.directionArea.xyz, toLight);
  if (hasEmitterLights && (!hasPointLights || kind == kindEmitter)) {
    float area = light.directionArea.w;
    float lobe = light.cone.w > 0.5 ? abs(cosine) : max(cosine, 0.0);
    return light.intensityRange.rgb * lobe * area / (distance2 + area / pi);
  }
  float falloff = 1.0 / max(distance2, light.directionArea.w);
  float range = light.intensityRange.w;
  if (range > 0.0) {
    float ratio2 = distance2 / (range * range);
    falloff *= clamp(1.0 - ratio2 * ratio2, 0.0, 1.0);
  }
  if (hasSpotLights && kind == kindSpot) {
    float angular = clamp(cosine * light.cone.x + light.cone.y, 0.0, 1.0);
    falloff *= angular * angular;
  }
  if (hasProfiledLights) {
    if (kind == kindProfiled) falloff *= profileIntensity(lampTables, entryOf(light), light.directionArea.xyz, light.cone.x, -toLight);
  }
  vec3 through = vec3(falloff);
  if (hasCookieLights) {
    if (kind == kindCookie) through *= throughCookie(cookieAt(entryOf(light)), light.directionArea.xyz, -toLight);
  }
  return light.intensityRange.rgb * through;
}

// Half the angle that a light is as large as which has no shape; 0: a point.
float radiusOf(Light light, vec3 point) {
  if (hasEmitterLights && kindOf(light) == kindEmitter) return atan(sqrt(light.directionArea.w / pi), distance(light.positionKind.xyz, point));
  if (hasDirectionalLights && kindOf(light) == kindDirectional) return light.directionArea.w;
  return light.cone.w > 0.0 && !isArea(light) ? asin(min(light.cone.w / max(distance(light.positionKind.xyz, point), 1e-9), 1.0)) : 0.0;
}

// Irradiance of an even disk on a surface whose normal is at a cosine to its middle, over that on a surface which faces it. Where the horizon
// cuts the disk off: the integral of the cosine over the part above, in the angle around the normal.
float cosineToDisk(float cosine, float radius) {
  float sine = sin(radius);
  if (!(radius > 0.0) || abs(cosine) >= sine) return max(cosine, 0.0);
  if (sine < 0.02) {  // flat: what is below would cancel in single precision
    float t = cosine / sine, s = sqrt(1.0 - t * t);
    return sine * (t * acos(-t) + s * (t * t + 2.0 / 3.0 * s * s)) / pi;
  }
  float x = sqrt(max(1.0 / (sine * sine) - 1.0, 0.0)), tilt = sqrt(max(1.0 - cosine * cosine, 1e-12));
  float y = clamp(-x * cosine / tilt, -1.0, 1.0);
  float rim = tilt * sqrt(1.0 - y * y);
  return max((cosine * acos(y) - x * rim + atan(rim, x) / (sine * sine)) / pi, 0.0);
}

// Irradiance on a surface of unit normal n, the direction that most of it comes from, and half the angle that the light is as
// large as: that of the ball which sends as much there as the part of a shape above the surface.
vec3 irradianceOn(Light light, vec3 point, vec3 n, out vec3 toLight, out float radius) {
  if (hasAreaLights) {
    if (isArea(light)) {
      vec3 sum = shapeVector(shapeFrom(light, point), n);
      float square = dot(sum, sum);
      toLight = square > 1e-30 ? sum * inversesqrt(square) : n;
      radius = asin(sqrt(clamp(sqrt(square) / pi, 0.0, 1.0)));
      return light.intensityRange.rgb * max(dot(sum, n), 0.0);
    }
  }
  radius = radiusOf(light, point);
  vec3 perpendicular = perpendicularIrradiance(light, point, toLight);
  bool isDisk = !hasEmitterLights || kindOf(light) != kindEmitter;
  return perpendicular * (isDisk ? cosineToDisk(dot(n, toLight), radius) : max(dot(n, toLight), 0.0));
}

// Irradiance of an emitter at a surface that faces it, without a root and with one division.
vec3 facingIrradianceOfEmitter(Light light, vec3 point, vec3 n) {
  vec3 path = light.positionKind.xyz - point;
  float distance2 = dot(path, path);
  float cosine = -dot(light.directionArea.xyz, path);
  float lobe = light.cone.w > 0.5 ? abs(cosine) : max(cosine, 0.0);
  float area = light.directionArea.w;
  float scale = lobe * max(dot(n, path), 0.0) * area / max(distance2 * (distance2 + area / pi), 1e-37);
  return scale * light.intensityRange.rgb;
}
