// Evaluation of materials at a point of the surface: emission, and the parameters of scattering.
// Options: PRELIGHT_TEXTURES (some material has a texture besides that of its base colour), those of the surface
// (transport/alpha_funcs.cl) and of transport/bsdf_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_MATERIAL_FUNCS_CL
#define PRELIGHT_TRANSPORT_MATERIAL_FUNCS_CL

#include "transport/bsdf_funcs.cl"
#include "transport/interaction_funcs.cl"

// Returns the value of a material's texture, PRELIGHT_*_TEXTURE, at a point; white where there is none.
PRELIGHT_INLINE float4 materialTexture(PathScene s, uint slot, uint triangle, float u, float v) {
#ifdef PRELIGHT_TEXTURES
  const DeviceTriangle t = s.surface.triangles[storedTriangle(s.surface, triangle).index];
  return textureAt(s.surface, s.materials[t.material].textures[slot], t, u, v);
#else
  return (float4)(1.0f);
#endif
}

// Returns true when an emissive triangle emits light on this side.
PRELIGHT_INLINE bool emitsOn(__global const ShadeMaterial* m, bool front) {
  return front || (m->flags & PRELIGHT_DOUBLE_SIDED) != 0u;
}

// Returns true when pictures do not show the backs of a surface. The boundary of solid glass has none
// (KHR_materials_volume).
PRELIGHT_INLINE bool isCulled(uint flags) { return (flags & (PRELIGHT_DOUBLE_SIDED | PRELIGHT_SOLID)) == 0u; }

#ifdef PRELIGHT_LAYERS
// Sets share and roughness of the clear coat.
PRELIGHT_INLINE void setCoat(PathScene s, __global const ShadeMaterial* m, uint triangle, float u, float v, Bsdf* b) {
  b->coat = m->coat * materialTexture(s, PRELIGHT_COAT_TEXTURE, triangle, u, v).x;
  b->coatRoughness = m->coatRoughness * materialTexture(s, PRELIGHT_COAT_ROUGHNESS_TEXTURE, triangle, u, v).y;
  b->coatSmooth = b->coatRoughness < PRELIGHT_SMOOTH_BELOW;
}

// Returns the share of an emitter's light along a direction that its clear coat lets out; the coat's bumps are ignored.
PRELIGHT_INLINE float leavesCoat(PathScene s, __global const ShadeMaterial* m, uint triangle, float u, float v, float3 direction) {
  if (!(m->coat > 0.0f)) return 1.0f;
  const DeviceTriangle t = triangleAt(s.surface, triangle);
  const float3 a = vertexPosition(s, t.vertex[0]), b = vertexPosition(s, t.vertex[1]), c = vertexPosition(s, t.vertex[2]);
  Bsdf coated;
  coated.albedos = s.albedos;
  setCoat(s, m, triangle, u, v, &coated);
  return 1.0f - coatAlbedo(coated, fmin(fabs(dot(direction, frontNormal(a, b, c))), 1.0f));
}
#endif

// Returns the radiance that a point of a triangle emits along a direction or against it.
PRELIGHT_INLINE float3 emittedRadiance(PathScene s, uint triangle, float u, float v, bool front, float3 direction) {
  __global const ShadeMaterial* m = s.materials + materialAt(s.surface, triangle);
  if (!emitsOn(m, front)) return (float3)(0.0f);
  const float3 radiance = vload3(0, m->emission) * materialTexture(s, PRELIGHT_EMISSION_TEXTURE, triangle, u, v).xyz;
#ifdef PRELIGHT_LAYERS
  return radiance * leavesCoat(s, m, triangle, u, v, direction);
#else
  return radiance;
#endif
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

// Sets the specular lobes: the share `metallic` of the surface is metal that reflects `base`, the share `opaque` has
// the dielectric's layer.
PRELIGHT_INLINE void setSpecular(PathScene s, Interaction i, float3 base, float metallic, float opaque, Bsdf* b) {
  __global const ShadeMaterial* m = s.materials + i.material;
  const bool unlit = (i.flags & PRELIGHT_UNLIT) != 0u;
  const float3 color = materialTexture(s, PRELIGHT_SPECULAR_COLOR_TEXTURE, i.triangle, i.u, i.v).xyz;
  const float f90 = m->specular * materialTexture(s, PRELIGHT_SPECULAR_TEXTURE, i.triangle, i.u, i.v).w;
  const float3 f0 = f90 * fmin(vload3(0, m->f0) * color, 1.0f);
#ifdef PRELIGHT_COLORED_GLASS
  b->glassF0 = f0;
  b->glassF90 = f90;
#endif
  setReflectance(base, unlit ? 0.0f : metallic, f0, f90, f90 > 0.0f ? opaque : 0.0f, b);
}

#ifdef PRELIGHT_ANISOTROPY
// Widens the lobe along the frame's x (KHR_materials_anisotropy).
PRELIGHT_INLINE void setAnisotropy(PathScene s, Interaction i, Bsdf* b) {
  __global const ShadeMaterial* m = s.materials + i.material;
  const float strength =
      i.stretched ? m->anisotropy * materialTexture(s, PRELIGHT_ANISOTROPY_TEXTURE, i.triangle, i.u, i.v).z : 0.0f;
  if (m->anisotropy > 0.0f) {
    b->roughness = fmax(b->roughness, PRELIGHT_SMOOTH_BELOW);
    b->alpha = b->roughness * b->roughness;
    b->smooth = false;
  }
  b->alphas = (float2)(mix(b->alpha, 1.0f, strength * strength), b->alpha);
}
#endif

#ifdef PRELIGHT_FILM
// Sets the film; must follow setCoat, because the coat lies over the film.
PRELIGHT_INLINE void setFilm(PathScene s, Interaction i, Bsdf* b) {
  __global const ShadeMaterial* m = s.materials + i.material;
  b->film.share = m->film > 0.0f ? m->film * materialTexture(s, PRELIGHT_FILM_TEXTURE, i.triangle, i.u, i.v).x : 0.0f;
  if (!(b->film.share > 0.0f)) return;
  b->film.relative = materialTexture(s, PRELIGHT_FILM_THICKNESS_TEXTURE, i.triangle, i.u, i.v).y;
  b->film.thickness = mix(m->filmThickness[0], m->filmThickness[1], b->film.relative);
  if (!(b->film.thickness > 0.0f)) b->film.share = 0.0f;
  b->film.ior = m->filmIor;
  b->film.table = (int)m->filmTable;
#ifdef PRELIGHT_LAYERS
  b->film.outside = 1.0f + 0.5f * b->coat;
#else
  b->film.outside = 1.0f;
#endif
}
#endif

#ifdef PRELIGHT_LAYERS
// Returns the coat's normal, which only the coat's own bumps turn, in the frame of the shading normal.
PRELIGHT_INLINE float3 coatNormalAt(PathScene s, Interaction i) {
#ifdef PRELIGHT_BUMPS
  const float3 front = i.front ? i.geometric : -i.geometric;
  const float3 unbumped = shadingNormal(s, i.triangle, i.u, i.v, front);
  __global const ShadeMaterial* m = s.materials + i.material;
  const float3 even = bumpedNormal(s, m->textures[PRELIGHT_COAT_NORMAL_TEXTURE], m->coatNormalScale, i.triangle, i.u, i.v, unbumped);
  return toFrame(i.frame, visibleNormal(i.front ? even : -even, i.geometric, i.wo));
#else
  return (float3)(0.0f, 0.0f, 1.0f);
#endif
}

PRELIGHT_INLINE void setLayers(PathScene s, Interaction i, Bsdf* b) {
  __global const ShadeMaterial* m = s.materials + i.material;
  setCoat(s, m, i.triangle, i.u, i.v, b);
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
#ifdef PRELIGHT_DISPERSION
  b.bentIor = m->ior;
#endif
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
#ifdef PRELIGHT_BUMPS
  b.bumped = m->textures[PRELIGHT_NORMAL_TEXTURE] != PRELIGHT_NO_TEXTURE;
  b.body = b.bumped ? toFrame(i.frame, i.body) : (float3)(0.0f, 0.0f, 1.0f);
#endif
#ifdef PRELIGHT_MEASURED
  b.measured = m->measured == PRELIGHT_NO_MEASURED ? 0 : s.measured + m->measured;
  b.measuredShare = m->measuredShare;
#endif
#ifdef PRELIGHT_ANISOTROPY
  setAnisotropy(s, i, &b);
#endif
#ifdef PRELIGHT_LAYERS
  setLayers(s, i, &b);
#endif
#ifdef PRELIGHT_FILM
  setFilm(s, i, &b);
#endif
  setSpecular(s, i, base, metallic, opaque, &b);
#ifdef PRELIGHT_TRANSLUCENT
  setTransmitted(s, i, opaque, &b);
#endif
  return b;
}

#endif
