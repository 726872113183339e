// Shading normals affect light that is traced from its source differently from light that is traced from the eye. Eye
// paths are the model; these functions are their adjoints. Light comes from i.wo and leaves along `direction`.
// [1] Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", ch. 5.3.
// Options: PRELIGHT_GLASS (some surface is glass).
#ifndef PRELIGHT_TRANSPORT_ADJOINT_FUNCS_CL
#define PRELIGHT_TRANSPORT_ADJOINT_FUNCS_CL

#include "transport/glass_funcs.cl"

// Keeps numbers finite. A lower bound would darken pictures: facets at which light grazes produce their caustics with
// such ratios alone.
#define PRELIGHT_MOST_ADJOINT 1e4f

// Returns the ratio of [1] eq. 5.19 for reflection, and for refraction when radiance scales with the square of the
// index of refraction and power does not. For mirrors the cosines with the shading normal cancel. Exactly 1 where both
// normals are equal.
PRELIGHT_INLINE float adjointRatio(Interaction i, float3 direction) {
  const float in = fabs(dot(i.wo, i.frame.z)) * fabs(dot(direction, i.geometric));
  const float out = fabs(dot(i.wo, i.geometric)) * fabs(dot(direction, i.frame.z));
  return in < PRELIGHT_MOST_ADJOINT * out ? in / out : PRELIGHT_MOST_ADJOINT;
}

#ifdef PRELIGHT_GLASS
// Probabilities with which sampleGlassRadiance continues an eye path that came from wo.
typedef struct GlassWays {
  float mirrored, passed;          // by the shading normal
  // By the triangle's own normal, where the shading normal would send it to the wrong side.
  float mirroredFlat, passedFlat;
} GlassWays;

// Returns the probabilities for wo and normals on its side.
static GlassWays glassWays(Bsdf b, bool solid, bool front, float3 wo, float3 shading, float3 geometric) {
  const float flat = glassReflectance(b, solid, front, glassCosine(wo, geometric));
  GlassWays ways = {0.0f, 0.0f, flat, 1.0f - flat};
  if (!(dot(wo, shading) > 0.0f)) return ways;
  const float bent = glassReflectance(b, solid, front, glassCosine(wo, shading));
  const bool mirrors = dot(mirrorAbout(wo, shading), geometric) >= 0.0f;
  const bool passes = bent < 1.0f && dot(passGlass(b, solid, front, wo, shading), geometric) < 0.0f;
  ways.mirrored = mirrors ? bent : 0.0f;
  ways.passed = passes ? 1.0f - bent : 0.0f;
  // Random numbers below `bent` were to be reflected. Of those for which that failed, the ones below `flat` are
  // reflected now.
  ways.mirroredFlat = (mirrors ? 0.0f : fmin(bent, flat)) + (passes ? 0.0f : fmax(flat - bent, 0.0f));
  ways.passedFlat = (mirrors ? 0.0f : fmax(bent - flat, 0.0f)) + (passes ? 0.0f : 1.0f - fmax(bent, flat));
  return ways;
}

// Samples the adjoint of sampleGlassRadiance, with the weight as a share of power. The eye reaches i.wo by the shading
// normal from one direction, and by the triangle's own normal from another, where that is its fallback: light from i.wo
// goes to both. Returns false when no light leaves.
static bool sampleGlassImportance(Interaction i, Bsdf b, float chance, GlassSample* g) {
  const bool solid = isSolid(i);
  const GlassWays own = glassWays(b, solid, i.front, i.wo, i.frame.z, i.geometric);
  float3 ways[4] = {mirrorAbout(i.wo, i.frame.z), i.wo, mirrorAbout(i.wo, i.geometric), i.wo};
  float shares[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  if (own.mirrored > 0.0f) shares[0] = own.mirrored * adjointRatio(i, ways[0]);
  if (own.passed > 0.0f) {
    ways[1] = passGlass(b, solid, i.front, i.wo, i.frame.z);
    shares[1] = own.passed * adjointRatio(i, ways[1]);
  }
  shares[2] = glassWays(b, solid, i.front, ways[2], i.frame.z, i.geometric).mirroredFlat;
  g->reflected = glassReflectance(b, solid, i.front, glassCosine(i.wo, i.geometric));
  if (g->reflected < 1.0f) {
    ways[3] = passGlass(b, solid, i.front, i.wo, i.geometric);
    shares[3] = glassWays(b, solid, !i.front, ways[3], -i.frame.z, -i.geometric).passedFlat;
  }
  const float sum = shares[0] + shares[1] + shares[2] + shares[3];
  if (!(sum > 0.0f)) return false;
  uint way = 0u;
  float rest = chance * sum;
  while (way < 3u && rest >= shares[way]) rest -= shares[way++];
  while (!(shares[way] > 0.0f)) --way;  // rounding
  g->passes = (way & 1u) != 0u;
  g->direction = ways[way];
  g->weight = sum * (g->passes ? b.tint : glassColor(b, solid, i.front, glassCosine(i.wo, i.frame.z)));
  g->eta2 = 1.0f;
  return true;
}

// Samples glass in either mode. Returns false when no light leaves.
PRELIGHT_INLINE bool sampleGlass(Interaction i, Bsdf b, uint mode, float chance, GlassSample* g) {
  if (mode == PRELIGHT_IMPORTANCE && !all(isequal(i.frame.z, i.geometric))) return sampleGlassImportance(i, b, chance, g);
  *g = sampleGlassRadiance(i, b, chance);
  if (mode == PRELIGHT_IMPORTANCE) g->eta2 = 1.0f;  // it scales radiance, not power
  return true;
}
#endif

#endif
