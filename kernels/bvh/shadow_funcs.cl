// Shadow rays past surfaces that let some of the light through: blended surfaces, and panes of thin glass
// (transport/straight_funcs.cl). Shares of light multiply. They are added up as logarithms to base 1/2 (halvings) in
// fixed point, so that the order in which a ray meets surfaces does not matter.
// Options: PRELIGHT_SHADOWS (needs PRELIGHT_ANY_HIT), PRELIGHT_PANES (some surface is a pane), those of the included files.
#ifndef PRELIGHT_BVH_SHADOW_FUNCS_CL
#define PRELIGHT_BVH_SHADOW_FUNCS_CL

#include "transport/alpha_funcs.cl"
#include "shared/ray_types.h"

#ifdef PRELIGHT_SHADOWS
#ifdef PRELIGHT_PANES
#include "transport/shaded_surface_funcs.cl"
#include "transport/straight_funcs.cl"
#endif

#define PRELIGHT_HALVING 1048576.0f       // units of the fixed-point number per halving
#define PRELIGHT_DARK (24u << 20)         // this many halvings count as darkness
#define PRELIGHT_SHADOW_EDGES 4u          // number of a ray's hits on edges that are remembered
#define PRELIGHT_ON_EDGE 1e-6f            // a weight below which a hit lies on an edge
#define PRELIGHT_SAME_DISTANCE 1e-5f      // relative difference of distances that count as equal

// The materials that decide what shadow rays pass.
typedef struct ShadowScene {
#ifdef PRELIGHT_PANES
  PathScene panes;
#else
  uint none;
#endif
} ShadowScene;

// A hit on an edge. The ray also meets the triangle beyond it, at about the same distance, and only the darker of the
// two counts.
typedef struct EdgeHit {
  float t;
  uint halvings[3];
} EdgeHit;

// The light that a shadow ray has lost so far.
typedef struct ShadowState {
  uint halvings[3];  // per channel, in fixed point
  uint edgeCount;
  EdgeHit edges[PRELIGHT_SHADOW_EDGES];
  bool pastPanes;
} ShadowState;

void startShadow(ShadowState* state) {
  for (uint c = 0; c < 3u; ++c) state->halvings[c] = 0u;
  state->edgeCount = 0u;
  state->pastPanes = false;
}

// Returns the share of the light that passes a surface where a ray meets it, rgb.
PRELIGHT_INLINE float3 passedShare(const ShadowScene* scene, Surface surface, Ray ray, Hit hit, ShadowState* state) {
  const float covered = surfaceCoverage(surface, hit.triangle, hit.u, hit.v);
#ifdef PRELIGHT_PANES
  if (covered > 0.0f && (surface.materials[materialAt(surface, hit.triangle)].flags & PRELIGHT_PANE) != 0u) {
    vstore3(normalize(vload3(0, ray.direction)), 0, ray.direction);
    const Interaction i = loadInteraction(scene->panes, ray, hit);
    const Bsdf b = loadBsdf(scene->panes, i);
    if (isPane(i, b)) {
      state->pastPanes = true;
      return (float3)(1.0f - covered) + covered * paneTransmittance(i, b);
    }
  }
#endif
  return (float3)(1.0f - covered);
}

// Adds the halvings of a surface. Of surfaces that share the edge that was hit, only the one that takes most counts.
PRELIGHT_INLINE void addHalvings(Hit hit, const uint* halvings, ShadowState* state) {
  uint before[3] = {0u, 0u, 0u};
  if (fmin(fmin(hit.u, hit.v), 1.0f - hit.u - hit.v) < PRELIGHT_ON_EDGE) {
    uint at = 0u;
    const uint known = min(state->edgeCount, PRELIGHT_SHADOW_EDGES);
    while (at < known && fabs(state->edges[at].t - hit.t) > PRELIGHT_SAME_DISTANCE * hit.t) ++at;
    if (at == known) {
      at = state->edgeCount++ % PRELIGHT_SHADOW_EDGES;
      state->edges[at].t = hit.t;
    } else {
      for (uint c = 0; c < 3u; ++c) before[c] = state->edges[at].halvings[c];
    }
    for (uint c = 0; c < 3u; ++c) state->edges[at].halvings[c] = max(before[c], halvings[c]);
  }
  for (uint c = 0; c < 3u; ++c)
    state->halvings[c] = min(state->halvings[c] + max(halvings[c], before[c]) - before[c], 2u * PRELIGHT_DARK);
}

// Accounts for a surface that a shadow ray meets. Returns false when no light passes it and those before.
bool passesSurface(const ShadowScene* scene, Surface surface, Ray ray, Hit hit, ShadowState* state) {
  const float3 share = passedShare(scene, surface, ray, hit, state);
  const float shares[3] = {share.x, share.y, share.z};
  uint halvings[3];
  bool passes = false;
  for (uint c = 0; c < 3u; ++c)
    halvings[c] = shares[c] > 0.0f ? min(convert_uint_rte(fmax(-log2(shares[c]), 0.0f) * PRELIGHT_HALVING), PRELIGHT_DARK)
                                   : PRELIGHT_DARK;
  addHalvings(hit, halvings, state);
  for (uint c = 0; c < 3u; ++c) passes = passes || state->halvings[c] < PRELIGHT_DARK;
  return passes;
}

// Returns the result of a shadow ray that nothing has blocked, with the shares of light in t, u and v.
PRELIGHT_INLINE Hit shadowHit(const ShadowState* state) {
  float shares[3];
  for (uint c = 0; c < 3u; ++c)
    shares[c] = state->halvings[c] < PRELIGHT_DARK ? exp2((float)state->halvings[c] / -PRELIGHT_HALVING) : 0.0f;
  const Hit hit = {shares[0], state->pastPanes ? PRELIGHT_PAST_PANES : PRELIGHT_NO_TRIANGLE, shares[1], shares[2]};
  return hit;
}
#endif

#endif
