// Light above the horizons that vertices have in sectors of azimuth (host/transfer/horizons.h); needs triangles.glsl.
// Max, "Horizon mapping: shadows for bump-mapped surfaces", 1988.
#include "core/dialect.h"
#include "surface_frame.glsl"

uniform TEXELS horizonAngles;  // [vertex][sector], radians above the tangent plane
uniform int horizonSectors;
uniform float horizonSoftness;  // angular radius of lamps without a size, radians

// Of a place on the front of a triangle.
struct Horizons {
  bool there;
  mat3 frame;
  ivec3 rows;    // first angles of the corners
  vec3 weights;  // of the corners
};

Horizons noHorizons() { return Horizons(false, mat3(1.0), ivec3(0), vec3(0.0)); }

Horizons horizonsAt(int triangle, vec3 point, vec3 n) {
  ivec3 corners = ivec3(FETCH(triangleCorners, triangle).xyz);
  vec3 weights = max(weightsOfCorners(corners, point), vec3(0.0));
  return Horizons(true, surfaceFrame(n), horizonSectors * corners, weights / (weights.x + weights.y + weights.z));
}

float angleOfSector(Horizons h, int sector) {
  return h.weights.x * FETCH(horizonAngles, h.rows.x + sector).x + h.weights.y * FETCH(horizonAngles, h.rows.y + sector).x +
         h.weights.z * FETCH(horizonAngles, h.rows.z + sector).x;
}

// Between the middles of sectors.
float horizonTowards(Horizons h, vec3 local) {
  float turn = abs(local.x) + abs(local.y) > 0.0 ? atan(local.y, local.x) / (2.0 * pi) : 0.0;
  float place = (turn + 1.0) * float(horizonSectors) - 0.5;
  int low = int(place);
  return mix(angleOfSector(h, low % horizonSectors), angleOfSector(h, (low + 1) % horizonSectors), place - float(low));
}

// How much of a disk of an angular radius lies above the horizon, whose edge is taken to be straight.
float diskAboveHorizon(Horizons h, vec3 direction, float radius) {
  vec3 local = transpose(h.frame) * direction;
  float height = asin(clamp(local.z, -1.0, 1.0)) - horizonTowards(h, local);
  float x = clamp(height / max(radius, 1e-4), -1.0, 1.0);
  return 0.5 + (x * sqrt(1.0 - x * x) + asin(x)) / pi;
}

// Half the angle that a light is as large as.
float radiusOf(Light light, vec3 point, vec3 toLight) {
  if (isArea(light))  // that of the ball which sends as much there
    return asin(sqrt(clamp(length(shapeVector(shapeFrom(light, point), toLight)) / pi, 0.0, 1.0)));
  if (hasEmitterLights && kindOf(light) == kindEmitter) return atan(sqrt(light.directionArea.w / pi), distance(light.positionKind.xyz, point));
  return horizonSoftness;
}

// What shadows leave of a lamp.
float lampAboveHorizon(Horizons h, Light light, vec3 point, vec3 toLight) {
  return diskAboveHorizon(h, toLight, radiusOf(light, point, toLight));
}

// The share of a reflected lobe above the horizon. Half of its energy lies within its cap, which stands for it.
float lobeAboveHorizon(Horizons h, float roughness, vec3 reflected) {
  return diskAboveHorizon(h, reflected, min(2.0 * atan(roughness * roughness), 0.5 * pi));
}
