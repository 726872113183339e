// Light within a body that scatters it: a random walk from surface to surface. Extinction is ShadeMaterial::absorption,
// of which the share `scattering` goes on, by the phase function of Henyey and Greenstein.
// [1] Novak, Georgiev, Hanika and Jarosz 2018, "Monte Carlo methods for volumetric light transport simulation", 4.
// [2] Henyey and Greenstein 1941, "Diffuse radiation in the galaxy".
// Distances are drawn for one channel, chosen in proportion to the walk's weight in each, and weighted by the mean of
// all channels' densities: the weight stays bounded however different the channels are.
#ifndef PRELIGHT_TRANSPORT_WALK_FUNCS_CL
#define PRELIGHT_TRANSPORT_WALK_FUNCS_CL

#include "core/sampling_funcs.cl"
#include "shared/walk_types.h"
#include "transport/medium_funcs.cl"

#define PRELIGHT_SURE_WALK 0.1f      // walks with a smaller weight go on by Russian roulette
#define PRELIGHT_MOST_STEPS 16384u  // walks that have been scattered so often count as absorbed

PRELIGHT_INLINE float nextChance(MediumWalk* walk) {
  walk->seed = hashInteger(walk->seed + 0x9e3779b9u);
  return unitFloat(walk->seed);
}

// Returns the probabilities with which a distance is drawn for each channel.
PRELIGHT_INLINE float3 channelChances(MediumWalk walk) {
  const float3 weight = vload3(0, walk.weight);
  const float sum = weight.x + weight.y + weight.z;
  return sum > 0.0f ? weight / sum : (float3)(1.0f / 3.0f);
}

PRELIGHT_INLINE void drawReach(PathScene s, MediumWalk* walk) {
  const float3 extinction = vload3(0, s.materials[walk->medium].absorption), chances = channelChances(*walk);
  const float chance = nextChance(walk);
  const float chosen = chance < chances.x ? extinction.x : (chance < chances.x + chances.y ? extinction.y : extinction.z);
  const float depth = -log(1.0f - nextChance(walk));
  walk->reach = chosen > 0.0f ? fmin(depth / chosen, MAXFLOAT) : MAXFLOAT;
}

// Multiplies a walk's weight by `carried` over the density with which its distance was drawn. `density`: that of the
// event in each channel.
PRELIGHT_INLINE void weighWalk(MediumWalk* walk, float3 carried, float3 density) {
  const float drawn = dot(channelChances(*walk), density);
  vstore3(drawn > 0.0f ? vload3(0, walk->weight) * (carried / drawn) : (float3)(0.0f), 0, walk->weight);
}

// Samples the cosine between the directions before and after scattering ([2]). u in [0,1).
PRELIGHT_INLINE float sampleHenyeyGreenstein(float g, float u) {
  if (fabs(g) < 1e-3f) return 1.0f - 2.0f * u;
  const float root = (1.0f - g * g) / (1.0f - g + 2.0f * g * u);
  return clamp((1.0f + g * g - root * root) / (2.0f * g), -1.0f, 1.0f);
}

// Returns a walk through `medium` that begins with a ray.
PRELIGHT_INLINE MediumWalk beginWalk(PathScene s, uint medium, uint origin, float3 carried, uint seed) {
  MediumWalk walk = {{carried.x, carried.y, carried.z}, origin, medium, MAXFLOAT, seed, 0u};
  drawReach(s, &walk);
  return walk;
}

PRELIGHT_INLINE MediumWalk noWalk(void) {
  const MediumWalk walk = {{0.0f, 0.0f, 0.0f}, 0u, PRELIGHT_NO_MEDIUM, 0.0f, 0u, 0u};
  return walk;
}

// Returns true when a walk along a ray meets a surface before it is scattered, and weights the walk for that.
PRELIGHT_INLINE bool meetsSurface(PathScene s, Hit hit, MediumWalk* walk) {
  const float3 extinction = vload3(0, s.materials[walk->medium].absorption);
  const bool there = hit.triangle != PRELIGHT_NO_TRIANGLE && hit.t <= walk->reach;
  if (!there && walk->reach < MAXFLOAT) return false;
  // Walks that leave the scene keep channels without a medium.
  const float3 left = exp(-extinction * (there ? hit.t : MAXFLOAT));
  weighWalk(walk, left, left);
  return true;
}

// Scatters a walk at the end of its ray. Returns false when it is absorbed.
PRELIGHT_INLINE bool scatterWalk(PathScene s, Ray* ray, MediumWalk* walk) {
  __global const ShadeMaterial* m = s.materials + walk->medium;
  const float3 extinction = vload3(0, m->absorption);
  const float3 density = extinction * exp(-extinction * walk->reach);
  weighWalk(walk, vload3(0, m->scattering) * density, density);
  const float survival = fmin(largest(vload3(0, walk->weight)) / PRELIGHT_SURE_WALK, 1.0f);
  if (++walk->steps >= PRELIGHT_MOST_STEPS || !(nextChance(walk) < survival)) return false;
  vstore3(vload3(0, walk->weight) / survival, 0, walk->weight);
  const float3 way = vload3(0, ray->direction);
  const float cosine = sampleHenyeyGreenstein(m->scatterAnisotropy, nextChance(walk));
  const float sine = sqrt(fmax(1.0f - cosine * cosine, 0.0f)), turn = 2.0f * nextChance(walk);
  const float3 turned = fromFrame(frameAround(way), (float3)(sine * cospi(turn), sine * sinpi(turn), cosine));
  vstore3(vload3(0, ray->origin) + walk->reach * way, 0, ray->origin);
  vstore3(normalize(turned), 0, ray->direction);
  ray->sourceTriangle = PRELIGHT_NO_TRIANGLE;
  drawReach(s, walk);
  ray->tMax = walk->reach;
  return true;
}

#endif
