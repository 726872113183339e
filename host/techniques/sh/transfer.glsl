// Light through baked diffuse transfer at a vertex, to be multiplied by the albedo; of a truncated series, it may dip below zero. Needs frame.glsl, sh_steps.glsl and lights.glsl, whose
// lights are those that the transfer is evaluated for vertex by vertex.
#include "core/dialect.h"
uniform int transferForm;         // TransferForm of drawn_transfer.h
uniform ivec4 transferShape;      // x: numbers a row, y: channels, z: order of SH or CH, 0: neither
uniform int transferIsCh;
uniform int transferHasRanges;
uniform float weightScale;
uniform int lightCount;
uniform TEXELS transfer;       // series: [vertex][channel][number / 4]; clusters: [vertex][component]
uniform TEXELS transferLight;  // series: [number], w: window of its band; clusters: [cluster][1 + component]
uniform TEXELS transferRanges; // [band][offset, scale]
uniform TEXELS chBasis;        // [m][l][k]
uniform UTEXELS clusters;      // [vertex]

#ifdef GL_ES
uniform mat3 lightTurn;  // of the lights, where the transfer turns the other way
#define TURNED(way) (lightTurn * (way))
#else
#define TURNED(way) (way)
#endif

const int formSeries = 0;
const int formClusters = 1;
const int maxTransferOrder = 32;

// Number i of a vertex whose first texel is `base`; l is its band.
vec3 transferNumber(int base, int i, int l) {
  int texels = (transferShape.x + 3) / 4;
  int texel = base + i / 4;
  vec3 t = vec3(FETCH(transfer, texel)[i % 4]);
  if (transferShape.y == 3) {
    t.g = FETCH(transfer, texel + texels)[i % 4];
    t.b = FETCH(transfer, texel + 2 * texels)[i % 4];
  }
  if (transferHasRanges != 0) t = FETCH(transferRanges, 2 * l).rgb + FETCH(transferRanges, 2 * l + 1).rgb * t;
  return t;
}

// What the transfer leaves of a light of irradiance 1 from a direction. Values of SH become moments of CH by one
// triangular product an m.
vec3 deltaThroughSeries(int base, vec3 w) {
  int order = transferShape.z;
  float values[maxTransferOrder];
  vec3 sum = vec3(0.0);
  ShSteps s = beginSh();
  for (int m = 0; m < order; ++m) {
    stepToSector(s, m, w);
    for (int l = m; l < order; ++l) {
      if (l > m) stepToBand(s, l, m, w);
      float windowed = FETCH(transferLight, l * (l + 1)).w * s.p;
      values[l] = windowed;
      float value = windowed;
      if (transferIsCh != 0) {
        value = 0.0;
        int row = (m * order + l) * order;
        for (int k = l; k >= m; k -= 2) value += FETCH(chBasis, row + k).x * values[k];
      }
      int zonal = l * (l + 1);
      sum += value * s.real * transferNumber(base, zonal + m, l);
      if (m > 0) sum += value * s.imaginary * transferNumber(base, zonal - m, l);
    }
  }
  return sum;
}

vec3 lightThroughSeries(int vertex, vec3 point) {
  int base = vertex * transferShape.y * ((transferShape.x + 3) / 4);
  vec3 sum = vec3(0.0);
  int l = 0;
  for (int i = 0; i < transferShape.x; ++i) {
    if (i >= (l + 1) * (l + 1)) ++l;
    sum += FETCH(transferLight, i).rgb * transferNumber(base, i, l);
  }
  if (transferShape.z == 0) return sum;
  for (int k = 0; k < lightCount; ++k) {
    vec3 toLight;
    vec3 irradiance = perpendicularIrradiance(lights[k], point, toLight);
    sum += irradiance * deltaThroughSeries(base, TURNED(toLight));
  }
  return sum;
}

vec3 lightThroughClusters(int vertex) {
  int components = transferShape.x;
  int term = int(FETCH(clusters, vertex).x) * (1 + components);
  vec3 sum = FETCH(transferLight, term).rgb;
  for (int j = 0; j < components; ++j) {
    float weight = weightScale * FETCH(transfer, vertex * components + j).x;
    sum += weight * FETCH(transferLight, term + 1 + j).rgb;
  }
  return sum;
}

vec3 transferredLight(int vertex, vec3 point) {
  return transferForm == formSeries ? lightThroughSeries(vertex, point) : lightThroughClusters(vertex);
}
