// Shading normals bend light that is traced from its source otherwise than light that is traced from the eye. What the eye's
// paths do is the model; these are its adjoints. Light comes from v.wo and leaves along `direction`.
// [1] Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", ch. 5.3.
#ifndef PRELIGHT_PHOTON_ADJOINT_FUNCS_CL
#define PRELIGHT_PHOTON_ADJOINT_FUNCS_CL

#include "shade/glass_funcs.cl"

// Keeps numbers finite. A lower bound would darken: a facet at which light grazes throws its caustic with such ratios alone.
#define PRELIGHT_MOST_ADJOINT 1e4f

// [1] eq. 5.19, of reflection, and of refraction if radiance scales with the square of the index of refraction and power does
// not. For mirrors the cosines with the shading normal cancel. Exactly 1 where both normals are one.
float adjointRatio(PathVertex v, float3 direction) {
  const float in = fabs(dot(v.wo, v.shading)) * fabs(dot(direction, v.geometric));
  const float out = fabs(dot(v.wo, v.geometric)) * fabs(dot(direction, v.shading));
  return in < PRELIGHT_MOST_ADJOINT * out ? in / out : PRELIGHT_MOST_ADJOINT;
}

#ifdef PRELIGHT_GLASS
// Chances with which leaveGlass sends a path of the eye that came from wo along each way.
typedef struct GlassWays {
  float mirrored, passed;          // by the shading normal
  float mirroredFlat, passedFlat;  // by the triangle's own, where the other would send it to the wrong side
} GlassWays;

// Normals on wo's side.
GlassWays glassWays(Bsdf b, bool solid, bool front, float3 wo, float3 shading, float3 geometric) {
  const float flat = glassReflectance(b, solid, front, glassCosine(wo, geometric));
  GlassWays ways = {0.0f, 0.0f, flat, 1.0f - flat};
  if (!(dot(wo, shading) > 0.0f)) return ways;
  const float bent = glassReflectance(b, solid, front, glassCosine(wo, shading));
  const bool mirrors = dot(mirrorAbout(wo, shading), geometric) >= 0.0f;
  const bool passes = bent < 1.0f && dot(passGlass(b, solid, front, wo, shading), geometric) < 0.0f;
  ways.mirrored = mirrors ? bent : 0.0f;
  ways.passed = passes ? 1.0f - bent : 0.0f;
  // Chances below `bent` were to be mirrored. Of those that failed, the ones below `flat` are now.
  ways.mirroredFlat = (mirrors ? 0.0f : fmin(bent, flat)) + (passes ? 0.0f : fmax(flat - bent, 0.0f));
  ways.passedFlat = (mirrors ? 0.0f : fmax(bent - flat, 0.0f)) + (passes ? 0.0f : 1.0f - fmax(bent, flat));
  return ways;
}

// The adjoint of leaveGlass, weight as a share of power. The eye comes to v.wo by the shading normal from one direction, and by
// the triangle's own from another, where that is its way out: light from v.wo goes to both. False: no light leaves.
bool sendThroughGlass(PathScene s, PathVertex v, Bsdf b, float chance, float3* direction, float3* weight, uint* medium) {
  const bool solid = (s.materials[v.material].flags & PRELIGHT_SOLID) != 0u;
  const GlassWays own = glassWays(b, solid, v.front, v.wo, v.shading, v.geometric);
  float3 ways[4] = {mirrorAbout(v.wo, v.shading), v.wo, mirrorAbout(v.wo, v.geometric), v.wo};
  float shares[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  if (own.mirrored > 0.0f) shares[0] = own.mirrored * adjointRatio(v, ways[0]);
  if (own.passed > 0.0f) {
    ways[1] = passGlass(b, solid, v.front, v.wo, v.shading);
    shares[1] = own.passed * adjointRatio(v, ways[1]);
  }
  shares[2] = glassWays(b, solid, v.front, ways[2], v.shading, v.geometric).mirroredFlat;
  if (glassReflectance(b, solid, v.front, glassCosine(v.wo, v.geometric)) < 1.0f) {
    ways[3] = passGlass(b, solid, v.front, v.wo, v.geometric);
    shares[3] = glassWays(b, solid, !v.front, ways[3], -v.shading, -v.geometric).passedFlat;
  }
  const float sum = shares[0] + shares[1] + shares[2] + shares[3];
  if (!(sum > 0.0f)) return false;
  uint way = 0u;
  float rest = chance * sum;
  while (way < 3u && rest >= shares[way]) rest -= shares[way++];
  while (!(shares[way] > 0.0f)) --way;  // rounding
  const bool passes = (way & 1u) != 0u;
  *direction = ways[way];
  *weight = sum * (passes ? b.tint : (float3)(1.0f));
  if (passes && solid) *medium = v.front ? v.material : PRELIGHT_NO_MEDIUM;
  return true;
}
#endif

#endif
