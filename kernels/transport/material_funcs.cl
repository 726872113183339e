// What materials say about a point of the surface: what it emits, and how it scatters light.
// Options: PRELIGHT_TEXTURES (some material has a texture besides that of its base colour), those of the surface
// (bvh/alpha_funcs.cl) and of transport/bsdf_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_MATERIAL_FUNCS_CL
#define PRELIGHT_TRANSPORT_MATERIAL_FUNCS_CL

#include "transport/bsdf_funcs.cl"
#include "transport/interaction_funcs.cl"

// A texture of a material at a point, PRELIGHT_*_TEXTURE; white where there is none.
PRELIGHT_INLINE float4 materialTexture(PathScene s, uint slot, uint triangle, float u, float v) {
#ifdef PRELIGHT_TEXTURES
  const DeviceTriangle t = s.surface.triangles[storedTriangle(s.surface, triangle).index];
  return textureAt(s.surface, s.materials[t.material].textures[slot], t, u, v);
#else
  return (float4)(1.0f);
#endif
}

// Light leaves an emissive triangle on this side.
PRELIGHT_INLINE bool emitsOn(__global const ShadeMaterial* m, bool front) {
  return front || (m->flags & PRELIGHT_DOUBLE_SIDED) != 0u;
}

// Radiance that a point of a triangle sends out.
PRELIGHT_INLINE float3 emittedRadiance(PathScene s, uint triangle, float u, float v, bool front) {
  __global const ShadeMaterial* m = s.materials + materialAt(s.surface, triangle);
  if (!emitsOn(m, front)) return (float3)(0.0f);
  return vload3(0, m->emission) * materialTexture(s, PRELIGHT_EMISSION_TEXTURE, triangle, u, v).xyz;
}

PRELIGHT_INLINE float3 baseColor(PathScene s, uint triangle, float u, float v) {
  return clamp(surfaceColor(s.surface, triangle, u, v).xyz, 0.0f, 1.0f);
}

#ifdef PRELIGHT_TRANSLUCENT
// Divides the body's light between its two sides. `opaque`: share of the surface that is neither metal nor glass.
PRELIGHT_INLINE void setTransmitted(PathScene s, Interaction i, float opaque, Bsdf* b) {
  __global const ShadeMaterial* m = s.materials + i.material;
  const float share = m->throughShare * materialTexture(s, PRELIGHT_THROUGH_TEXTURE, i.triangle, i.u, i.v).w;
  const float3 color = vload3(0, m->through) * materialTexture(s, PRELIGHT_THROUGH_COLOR_TEXTURE, i.triangle, i.u, i.v).xyz;
  b->diffuse *= 1.0f - share;
  b->transmitted = opaque * share * color;
}
#endif

// The share `metallic` of the surface reflects `base`, the share `opaque` has the dielectric's layer.
PRELIGHT_INLINE void setSpecular(PathScene s, Interaction i, float3 base, float metallic, float opaque, Bsdf* b) {
  __global const ShadeMaterial* m = s.materials + i.material;
  const bool unlit = (i.flags & PRELIGHT_UNLIT) != 0u;
  const float3 color = materialTexture(s, PRELIGHT_SPECULAR_COLOR_TEXTURE, i.triangle, i.u, i.v).xyz;
  const float f90 = m->specular * materialTexture(s, PRELIGHT_SPECULAR_TEXTURE, i.triangle, i.u, i.v).w;
  const float3 f0 = f90 * fmin(vload3(0, m->f0) * color, 1.0f);
  setReflectance(base, unlit ? 0.0f : metallic, f0, f90, f90 > 0.0f ? opaque : 0.0f, b);
}

#ifdef PRELIGHT_LAYERS
// The shading normal without the bumps of the material below the coat, in its frame.
PRELIGHT_INLINE float3 coatNormalAt(PathScene s, Interaction i) {
#ifdef PRELIGHT_BUMPS
  const float3 front = i.front ? i.geometric : -i.geometric;
  const float3 even = shadingNormal(s, i.triangle, i.u, i.v, front);
  return toFrame(i.frame, visibleNormal(i.front ? even : -even, i.geometric, i.wo));
#else
  return (float3)(0.0f, 0.0f, 1.0f);
#endif
}

PRELIGHT_INLINE void setLayers(PathScene s, Interaction i, Bsdf* b) {
  __global const ShadeMaterial* m = s.materials + i.material;
  b->coat = m->coat * materialTexture(s, PRELIGHT_COAT_TEXTURE, i.triangle, i.u, i.v).x;
  b->coatRoughness = m->coatRoughness * materialTexture(s, PRELIGHT_COAT_ROUGHNESS_TEXTURE, i.triangle, i.u, i.v).y;
  b->coatSmooth = b->coatRoughness < PRELIGHT_SMOOTH_BELOW;
  b->coatNormal = coatNormalAt(s, i);
  b->sheen = vload3(0, m->sheen) * materialTexture(s, PRELIGHT_SHEEN_COLOR_TEXTURE, i.triangle, i.u, i.v).xyz;
  const float roughness = m->sheenRoughness * materialTexture(s, PRELIGHT_SHEEN_ROUGHNESS_TEXTURE, i.triangle, i.u, i.v).w;
  b->sheenRoughness = fmax(roughness, PRELIGHT_LEAST_SHEEN_ROUGHNESS);
  b->sheenAlpha = b->sheenRoughness * b->sheenRoughness;
}
#endif

PRELIGHT_INLINE Bsdf loadBsdf(PathScene s, Interaction i) {
  __global const ShadeMaterial* m = s.materials + i.material;
  const float4 texel = materialTexture(s, PRELIGHT_SURFACE_TEXTURE, i.triangle, i.u, i.v);
  const bool unlit = (i.flags & PRELIGHT_UNLIT) != 0u;
  const float3 base = baseColor(s, i.triangle, i.u, i.v) * (unlit ? 0.0f : 1.0f);
  const float metallic = m->metallic * texel.z;
  const float roughness = m->roughness * texel.y;
  const float glass = m->transmission * materialTexture(s, PRELIGHT_GLASS_TEXTURE, i.triangle, i.u, i.v).x;
  const float opaque = (1.0f - metallic) * (1.0f - glass);
  Bsdf b;
  b.diffuse = opaque * base;
  b.glass = unlit ? 0.0f : (1.0f - metallic) * glass;
  b.tint = base;
  b.ior = m->ior;
#ifdef PRELIGHT_ROUGH_GLASS
  b.solid = isSolid(i);
  b.eta = relativeIor(b, b.solid, i.front);
  b.inside = !i.front;
  b.glassTable = m->glassTable;
#endif
  b.roughness = roughness;
  b.alpha = roughness * roughness;
  b.smooth = roughness < PRELIGHT_SMOOTH_BELOW;
  b.albedos = s.albedos;
  setSpecular(s, i, base, metallic, opaque, &b);
#ifdef PRELIGHT_TRANSLUCENT
  setTransmitted(s, i, opaque, &b);
#endif
#ifdef PRELIGHT_LAYERS
  setLayers(s, i, &b);
#endif
  return b;
}

#endif
