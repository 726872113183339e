// Light through baked diffuse transfer at a vertex, to be multiplied by the albedo. Sums of truncated series may dip below zero, but for those of
// a sky whose smoothed numbers are known. Needs frame.glsl, sh_steps.glsl and lights.glsl, whose lights are those that come through the transfer.
#include "core/dialect.h"
#include "core/largest_funcs.cl"
#include "core/ringing_funcs.cl"
uniform int transferForm;         // TransferForm of transfer_pass.h
uniform ivec4 transferShape;      // x: series: numbers a row, clusters: components; y: channels, z: order of SH or CH, 0: neither; w: above 0: the smoothed sky is known; of clusters, their number
uniform int transferIsCh;
uniform int transferHasRanges;
uniform float weightScale;
uniform int lightCount;
uniform TEXELS transfer;       // series: [vertex][channel][number / 4]; clusters: [vertex][component]
uniform TEXELS transferLight;  // series: [number] of the sky, then, where they are known, those of the smoothed sky; clusters: [sky, smoothed sky][cluster][1 + component]
uniform TEXELS transferRanges; // [band][offset, scale]
uniform TEXELS chBasis;        // [m][l][k]
uniform UTEXELS clusters;      // [vertex]
uniform TEXELS clusterRows;    // [cluster][1 + component][channel][number / 4], bound where there are lamps

#ifdef GL_ES
uniform mat3 lightTurn;  // of the lights, where the transfer turns the other way
#define TURNED(way) (lightTurn * (way))
#else
#define TURNED(way) (way)
#endif

const int formSeries = 0;
const int formClusters = 1;
const int maxTransferOrder = 32;

// Kinds of rows: transfer of fronts, transfer of other sides, and rows of a matrix.
const int rowOfFront = 0;
const int rowBehind = 1;
const int rowOfMatrix = 2;

const float leastOpen = 1e-4;     // smaller values are at the horizon, where no light counts
const float shadowSlope = 2.0;    // of edges that truncation has blurred
const float leastSoft = 0.014;    // half the angle of the smallest lights whose shadows have soft edges, rad

// Number i of the row of `count` numbers a channel whose first texel is `base`.
vec3 storedNumber(TEXELS rows, int base, int count, int i) {
  int texels = (count + 3) / 4;
  int texel = base + i / 4;
  vec3 t = vec3(FETCH(rows, texel)[i % 4]);
  if (transferShape.y == 3) {
    t.g = FETCH(rows, texel + texels)[i % 4];
    t.b = FETCH(rows, texel + 2 * texels)[i % 4];
  }
  return t;
}

int firstTexel(int row, int count) { return row * transferShape.y * ((count + 3) / 4); }

// Number i of a vertex; l is its band.
vec3 numberOfSeries(int vertex, int i, int l) {
  vec3 t = storedNumber(transfer, firstTexel(vertex, transferShape.x), transferShape.x, i);
  if (transferHasRanges != 0) t = FETCH(transferRanges, 2 * l).rgb + FETCH(transferRanges, 2 * l + 1).rgb * t;
  return t;
}

vec3 numberOfClusters(int vertex, int i) {
  int components = transferShape.x;
  int count = transferShape.z * transferShape.z;
  int row = int(FETCH(clusters, vertex).x) * (1 + components);
  vec3 sum = storedNumber(clusterRows, firstTexel(row, count), count, i);
  for (int j = 0; j < components; ++j) {
    float weight = weightScale * FETCH(transfer, vertex * components + j).x;
    sum += weight * storedNumber(clusterRows, firstTexel(row + 1 + j, count), count, i);
  }
  return sum;
}

vec3 transferNumber(int vertex, int i, int l) {
  return transferForm == formSeries ? numberOfSeries(vertex, i, l) : numberOfClusters(vertex, i);
}

// The cosine of half the angle that a light is as large as from a point that it sends `perpendicular` to, straight on: of a shape, that
// of the disk which sends as much.
float cosineOfRadius(Light light, vec3 point, vec3 perpendicular) {
  if (isArea(light)) return sqrt(max(1.0 - largest(perpendicular) / (pi * largest(light.intensityRange.rgb)), 0.0));
  return cos(radiusOf(light, point));
}

// Factors of the bands of a disk that sends an irradiance of 1 straight on, by the cosine c of half its angle: 2 P_l'(c) / (l (l + 1)).
void bandsOfDisk(float cosine, out float bands[maxTransferOrder]) {
  float slope = 1.0, before = 0.0;
  for (int l = 0; l < transferShape.z; ++l) {
    if (l > 1) {
      float next = (float(2 * l - 1) * cosine * slope - float(l) * before) / float(l - 1);
      before = slope;
      slope = next;
    }
    bands[l] = l == 0 ? 2.0 / (1.0 + cosine) : 2.0 * slope / float(l * (l + 1));
  }
}

// Returns the share that the transfer leaves of a light in these bands about a direction. Values of SH become moments of CH by one
// triangular product an m.
vec3 diskThrough(int vertex, vec3 w, float bands[maxTransferOrder]) {
  int order = transferShape.z;
  float values[maxTransferOrder];
  vec3 sum = vec3(0.0);
  ShSteps s = beginSh();
  for (int m = 0; m < order; ++m) {
    stepToSector(s, m, w);
    for (int l = m; l < order; ++l) {
      if (l > m) stepToBand(s, l, m, w);
      float value = bands[l] * s.p;
      values[l] = value;
      if (transferIsCh != 0) {
        value = 0.0;
        int row = (m * order + l) * order;
        for (int k = l; k >= m; k -= 2) value += FETCH(chBasis, row + k).x * values[k];
      }
      int zonal = l * (l + 1);
      sum += value * s.real * transferNumber(vertex, zonal + m, l);
      if (m > 0) sum += value * s.imaginary * transferNumber(vertex, zonal - m, l);
    }
  }
  return sum;
}

// Returns what an open receiver makes of a disk, by the cosine between its normal and the disk's middle.
float diskInTheOpen(float cosine, float bands[maxTransferOrder]) {
  OpenSteps s = beginOpen();
  float sum = 0.0;
  for (int l = 0; l < transferShape.z; ++l) sum += bands[l] * bandOfOpen(s, l, cosine);
  return 0.0795774715 * sum;  // 1 / (4 pi)
}

// A lamp's light at a receiver: lampThroughTransfer() of host/basis/lights/lamp_through_transfer.h.
vec3 lampThrough(Light light, int vertex, vec3 point, vec3 normal, int row) {
  vec3 toLight;
  vec3 irradiance = perpendicularIrradiance(light, point, toLight);
  if (irradiance == vec3(0.0)) return irradiance;
  float bands[maxTransferOrder];
  float cosine = cosineOfRadius(light, point, irradiance);
  bandsOfDisk(cosine, bands);
  vec3 through = diskThrough(vertex, TURNED(toLight), bands);
  if (row == rowOfMatrix) return irradiance * through;
  vec3 n = row == rowBehind ? -normal : normal;
  float open = diskInTheOpen(dot(n, toLight), bands);
  if (abs(open) < leastOpen) open = leastOpen;
  vec3 share = clamp(through / open, 0.0, 1.0);
  bool isSoft = isArea(light) || radiusOf(light, point) >= leastSoft;
  float slope = row == rowOfFront && transferShape.y == 1 && !isSoft ? shadowSlope : 1.0;
  vec3 way;
  float radius;
  vec3 facing = irradianceOn(light, point, n, way, radius) / pi;
  return max(irradiance * (through - share * open) + clamp(0.5 + slope * (share - 0.5), 0.0, 1.0) * facing, 0.0);
}

// Light of numbers that begin at a texel.
vec3 productOfSeries(int vertex, int first) {
  vec3 sum = vec3(0.0);
  int l = 0;
  for (int i = 0; i < transferShape.x; ++i) {
    if (i >= (l + 1) * (l + 1)) ++l;
    sum += FETCH(transferLight, first + i).rgb * numberOfSeries(vertex, i, l);
  }
  return sum;
}

// Numbers of matrices may be negative.
vec3 lightThroughSeries(int vertex, int row) {
  vec3 sum = productOfSeries(vertex, 0);
  return transferShape.w == 0 || row == rowOfMatrix ? sum : withoutRinging(sum, productOfSeries(vertex, transferShape.x));
}

// Light of terms of all clusters that begin at a texel.
vec3 productOfClusters(int vertex, int first) {
  int components = transferShape.x;
  int term = first + int(FETCH(clusters, vertex).x) * (1 + components);
  vec3 sum = FETCH(transferLight, term).rgb;
  for (int j = 0; j < components; ++j) {
    float weight = weightScale * FETCH(transfer, vertex * components + j).x;
    sum += weight * FETCH(transferLight, term + 1 + j).rgb;
  }
  return sum;
}

vec3 lightThroughClusters(int vertex) {
  return withoutRinging(productOfClusters(vertex, 0), productOfClusters(vertex, transferShape.w * (1 + transferShape.x)));
}

vec3 transferredLight(int vertex, vec3 point, vec3 normal, int row) {
  vec3 sum = transferForm == formSeries ? lightThroughSeries(vertex, row) : lightThroughClusters(vertex);
  for (int k = 0; k < lightCount; ++k) sum += lampThrough(lights[k], vertex, point, normal, row);
  return sum;
}
