#version 410 core
// How much of the light of near lamps arrives at a vertex: lampVisibility() of host/techniques/near_lamps/lamp_shells.h, of lamps with several places
// the mean of their sharpened() visibilities by the light that they would send.
#include "sh_steps.glsl"
#include "core/dialect.h"

#ifdef GL_ES
uniform TEXELS cornerPositions;  // [vertex]
uniform TEXELS vertexNormals;
#define position FETCH(cornerPositions, gl_VertexID).xyz
#define normal FETCH(vertexNormals, gl_VertexID).xyz
uniform TEXELS texelsNext;  // of the next key of an animation
uniform float nextShare;    // of that key
uniform mat3 lightTurn;     // of the lamps, where the vertices have turned the other way since each key
uniform mat3 lightTurnNext;
#else
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
#endif

uniform TEXELS texels;         // [vertex][shell][number / 4]
uniform ivec4 shellShape;      // x: order of SH, y: shells
uniform vec4 shellRange;       // x: nearest distance, y: shells a factor e of distance, z: lag in shells
uniform vec4 places[32];       // w: 1 where light leaves to one side, 2 to both, 0 of a point to all
uniform vec3 placeNormals[32];
uniform ivec4 placesEnd;       // of four lamps, one behind the other
uniform int lampCount;

out vec4 lampVisibility;

// Number i of a vertex's shells together, each with the share of it that is before `place`, in shells.
float blockedNumber(TEXELS rows, int i, float place) {
  int texelsARow = (shellShape.x * shellShape.x + 3) / 4;
  float sum = 0.0;
  for (int k = 0; k < shellShape.y && place > float(k); ++k) {
    int row = gl_VertexID * shellShape.y + k;
    sum += min(place - float(k), 1.0) * FETCH(rows, row * texelsARow + i / 4)[i % 4];
  }
  return sum;
}

float blockedIn(TEXELS rows, vec3 w, float place) {
  float sum = 0.0;
  ShSteps s = beginSh();
  for (int m = 0; m < shellShape.x; ++m) {
    stepToSector(s, m, w);
    for (int l = m; l < shellShape.x; ++l) {
      if (l > m) stepToBand(s, l, m, w);
      int zonal = l * (l + 1);
      sum += s.p * s.real * blockedNumber(rows, zonal + m, place);
      if (m > 0) sum += s.p * s.imaginary * blockedNumber(rows, zonal - m, place);
    }
  }
  return sum;
}

float blockedTowards(vec3 w, float place) {
#ifdef GL_ES
  float blocked = blockedIn(texels, lightTurn * w, place);
  return nextShare > 0.0 ? mix(blocked, blockedIn(texelsNext, lightTurnNext * w, place), nextShare) : blocked;
#else
  return blockedIn(texels, w, place);
#endif
}

// Share of light from the unit direction w that arrives from a distance.
float visibilityOf(vec3 n, vec3 w, float distance) {
  float open = openTowards(dot(n, w), shellShape.x);
  float place = log(distance / shellRange.x) * shellRange.y - shellRange.z;
  return open > 1e-4 ? clamp(1.0 - blockedTowards(w, place) / open, 0.0, 1.0) : 1.0;
}

float sharpened(float visibility) { return clamp(0.5 + 3.0 * (visibility - 0.5), 0.0, 1.0); }

float lampVisibilityOf(int first, int end, vec3 n) {
  float sum = 0.0;
  float all = 0.0;
  for (int i = first; i < end; ++i) {
    vec3 path = places[i].xyz - position;
    float d = max(length(path), 1e-15);
    vec3 w = path / d;
    if (end == first + 1) return visibilityOf(n, w, d);
    float cosine = -dot(placeNormals[i], w);
    float lobe = places[i].w > 1.5 ? abs(cosine) : max(cosine, 0.0);
    float share = lobe * max(dot(n, w), 0.0) / max(d * d, 1e-20);
    if (share <= 0.0) continue;
    sum += share * sharpened(visibilityOf(n, w, d));
    all += share;
  }
  return all > 0.0 ? sum / all : 1.0;
}

void main() {
  lampVisibility = vec4(1.0);
  vec3 n = normal * inversesqrt(max(dot(normal, normal), 1e-30));
  for (int k = 0; k < lampCount; ++k) {
    int first = k == 0 ? 0 : placesEnd[k - 1];
    lampVisibility[k] = lampVisibilityOf(first, placesEnd[k], n);
  }
  gl_Position = vec4(0.0);
}
