// Light past the bands of heights that are closed to vertices in sectors of azimuth, from a foot to a horizon
// (host/techniques/horizons/horizon_bands.h); needs triangles.glsl.
// Max, "Horizon mapping: shadows for bump-mapped surfaces", 1988.
#include "core/dialect.h"
#include "surface_frame.glsl"

uniform TEXELS horizonBands;  // [vertex][sector], x: foot, y: horizon, radians above the tangent plane
uniform int horizonSectors;
uniform float horizonSoftness;  // angular radius of lamps without a size, radians

// Horizons of a place on the front of a triangle.
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

// How much of a disk lies above a straight edge that its middle is so much higher than.
float diskAbove(float height, float radius) {
  float x = clamp(height / radius, -1.0, 1.0);
  return 0.5 + (x * sqrt(1.0 - x * x) + asin(x)) / pi;
}

// Bands about a direction: the horizon of those that stand on the surface, and how much of a disk those that hang above it hide.
struct Bands {
  float horizon;
  float hidden;
};

// Adds the band of one vertex and sector. Where a band of a vertex hangs and its neighbour's does not, neither edge says where it is
// between them: what it hides fades out, as standing horizons, which are there for both, do not.
void addBand(inout Bands bands, int row, float weight, float height, float radius) {
  vec2 band = FETCH(horizonBands, row).xy;
  vec2 above = clamp(vec2(0.5) + (vec2(height) - band) / (2.0 * radius), vec2(0.0), vec2(1.0));
  bool hangs = band.x > 0.0;
  bands.horizon += hangs ? 0.0 : weight * band.y;
  bands.hidden += hangs ? weight * (above.x - above.y) : 0.0;
}

// How much of a disk of an angular radius is seen past the bands, between the middles of sectors.
float diskPastBands(Horizons h, vec3 direction, float radius) {
  vec3 local = transpose(h.frame) * direction;
  float height = asin(clamp(local.z, -1.0, 1.0));
  radius = max(radius, 1e-4);
  float turn = abs(local.x) + abs(local.y) > 0.0 ? atan(local.y, local.x) / (2.0 * pi) : 0.0;
  float place = (turn + 1.0) * float(horizonSectors) - 0.5;
  int low = int(place);
  float share = place - float(low);
  Bands bands = Bands(0.0, 0.0);
  for (int k = 0; k < 2; ++k) {
    int sector = (low + k) % horizonSectors;
    vec3 weights = h.weights * (k == 0 ? 1.0 - share : share);
    addBand(bands, h.rows.x + sector, weights.x, height, radius);
    addBand(bands, h.rows.y + sector, weights.y, height, radius);
    addBand(bands, h.rows.z + sector, weights.z, height, radius);
  }
  return diskAbove(height - bands.horizon, radius) * (1.0 - bands.hidden);
}

// Returns the share of a lamp's light that shadows leave; radius: half the angle of the lamp. A lamp of a sky is no sharper than other lamps without
// a size: horizons of vertices are not as fine as the sun's disk.
float lampAboveHorizon(Horizons h, Light light, vec3 toLight, float radius) {
  return diskPastBands(h, toLight, radius > 0.0 && !isOfSky(light) ? radius : max(radius, horizonSoftness));
}

// The share of a reflected lobe above the horizon. Half of its energy lies within its cap, which stands for it.
float lobeAboveHorizon(Horizons h, float roughness, vec3 reflected) {
  return diskPastBands(h, reflected, min(2.0 * atan(roughness * roughness), 0.5 * pi));
}
