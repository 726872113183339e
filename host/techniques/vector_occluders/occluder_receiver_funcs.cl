// Reflection of light by receivers, in OpenCL C and in GLSL.
// [1] Fujii, "A tiny improvement of Oren-Nayar reflectance model", 2012.
// [2] Walter et al., "Microfacet models for refraction through rough surfaces", 2007 (GGX).
// [3] Heitz, "Understanding the masking-shadowing function", 2014 (height-correlated Smith).
#ifndef PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_RECEIVER_FUNCS_CL
#define PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_RECEIVER_FUNCS_CL

#include "techniques/vector_occluders/occluder_light_funcs.cl"

#define LEAST_ALPHA 0.002f
// Least alpha for the share of the lights' reflection that shadows leave. It is wider than LEAST_ALPHA, because points
// between vertices must find their light in the vertices' shares.
#define LEAST_SHARE_ALPHA 0.02f

// A receiver as the eye sees it. Directions are unit.
STRUCT_NAME(LitReceiver)
struct LitReceiver {
  vec3 position;
  vec3 normal;
  vec3 toEye;
  vec3 f0;
  float roughness;
};

vec3 directionToEye(vec3 position, OccluderTerms terms) {
  vec3 eye = VEC3(terms.eyeX, terms.eyeY, terms.eyeZ);
  return terms.eyeIsPoint > 0.5f ? unitOf(eye - position) : eye;
}

bool isGlossy(LitReceiver receiver) { return max(receiver.f0.x, max(receiver.f0.y, receiver.f0.z)) > 0.0f; }

// Returns the ratio of Oren-Nayar to Lambert for light from a direction, with the roughness as the slopes' deviation in
// radians: [1].
float roughDiffuse(LitReceiver receiver, vec3 toLight) {
  float nl = dot(receiver.normal, toLight);
  float nv = max(dot(receiver.normal, receiver.toEye), 0.0f);
  float s = dot(toLight, receiver.toEye) - nl * nv;
  float scale = 1.0f / (OCCLUDER_PI + (0.5f * OCCLUDER_PI - 2.0f / 3.0f) * receiver.roughness);
  float t = s > 0.0f ? max(max(nl, nv), 1e-4f) : 1.0f;
  return max(OCCLUDER_PI * scale * (1.0f + receiver.roughness * s / t), 0.0f);
}

vec3 fresnelOf(vec3 f0, float cosine) {
  float away = clamp(1.0f - cosine, 0.0f, 1.0f);
  float away2 = away * away;
  return f0 + (VEC3(1.0f) - f0) * (away2 * away2 * away);
}

// Returns the distribution times the visibility of GGX, without Fresnel's factor: specularBrdf() of
// viewer/shaders/scattering.glsl.
float microfacets(LitReceiver receiver, vec3 toLight, float leastAlpha) {
  vec3 h = unitOf(receiver.toEye + toLight);
  float nl = max(dot(receiver.normal, toLight), 0.0f);
  float nv = max(dot(receiver.normal, receiver.toEye), 1e-4f);
  float nh = clamp(dot(receiver.normal, h), 0.0f, 1.0f);
  float alpha = max(receiver.roughness * receiver.roughness, leastAlpha);
  float a2 = alpha * alpha;
  // Computes 1 - nh^2 by the cross product: at nh = 1 the difference would have no digits.
  vec3 across = cross(receiver.normal, h);
  float d = dot(across, across) + nh * nh * a2;
  float distribution = a2 / (OCCLUDER_PI * max(d * d, 1e-12f));  // [2] Eq. 33
  float lightSide = nl * sqrt(nv * nv * (1.0f - a2) + a2);
  float eyeSide = nv * sqrt(nl * nl * (1.0f - a2) + a2);
  return distribution * 0.5f / max(lightSide + eyeSide, 1e-6f);  // [3]
}

vec3 glossyReflection(LitReceiver receiver, vec3 toLight) {
  vec3 h = unitOf(receiver.toEye + toLight);
  return microfacets(receiver, toLight, LEAST_ALPHA) * fresnelOf(receiver.f0, max(dot(receiver.toEye, h), 0.0f));
}

#endif
