#version 410 core
// Mean of a cube map over the lobe of GGX microfacets seen along the normal and weighted by the cosine (basis/sky_lobes.h), about
// the direction of a texel. Every direction stands for an equal share of the half vectors and reads a mip level whose texels
// are half as wide as what it stands for, as a bilinear look-up is two texels wide (Krivanek and Colbert 2008, "Real-time shading with filtered importance sampling").
uniform samplerCubeArray maps;
uniform int face;
uniform float side;   // texels of the face that is drawn
uniform float alpha;  // roughness^2 of the lobe

layout(location = 0) out vec4 mean;

#include "cube_directions.glsl"

const int directions = 64;
const float pi = 3.14159265358979;
const float turn = 2.39996323;  // the golden angle

void main() {
  vec3 axis = normalize(directionOn(face, 2.0 * gl_FragCoord.xy / side - 1.0));
  vec3 aside = normalize(cross(axis, abs(axis.z) < 0.7 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
  vec3 across = cross(axis, aside);
  float square = alpha * alpha, texel = 4.0 * pi / (6.0 * float(textureSize(maps, 0).x * textureSize(maps, 0).x));
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int k = 0; k < directions; ++k) {
    float u = (float(k) + 0.5) / float(directions), angle = turn * float(k);
    float half2 = (1.0 - u) / (1.0 - u + square * u), cosine = 2.0 * half2 - 1.0;  // of the half vector, squared; of the direction
    if (cosine <= 0.0) break;
    float narrowing = half2 * (square - 1.0) + 1.0;
    float stoodFor = 4.0 * pi * narrowing * narrowing / (square * float(directions));
    float sine = sqrt(1.0 - cosine * cosine);
    vec3 way = cosine * axis + sine * (cos(angle) * aside + sin(angle) * across);
    sum += cosine * textureLod(maps, vec4(way, 0.0), max(0.5 * log2(stoodFor / texel) - 1.0, 0.0));
    weights += cosine;
  }
  mean = sum / weights;
}
