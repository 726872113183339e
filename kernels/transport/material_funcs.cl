// What materials say about a point of the surface: what it emits, and how it scatters light.
// Options: PRELIGHT_LAYER_TEXTURES (some material has a texture besides that of its base colour), those of the surface
// (bvh/alpha_funcs.cl) and of transport/bsdf_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_MATERIAL_FUNCS_CL
#define PRELIGHT_TRANSPORT_MATERIAL_FUNCS_CL

#include "transport/bsdf_funcs.cl"
#include "transport/interaction_funcs.cl"

#define PRELIGHT_LAYER_BASE 0u
#define PRELIGHT_LAYER_SURFACE 1u  // G roughness, B metalness
#define PRELIGHT_LAYER_EMISSION 2u
#define PRELIGHT_LAYER_THROUGH 3u  // no texture yet: see loadBsdf
#define PRELIGHT_LAYERS 4u

PRELIGHT_INLINE float2 vertexTexCoord(PathScene s, uint triangle, float u, float v) {
  const DeviceTriangle t = s.surface.triangles[storedTriangle(s.surface, triangle).index];
  return (1.0f - u - v) * s.surface.texCoords[t.vertex[0]] + u * s.surface.texCoords[t.vertex[1]] +
         v * s.surface.texCoords[t.vertex[2]];
}

// Texture `layer` of a material at a point; white where there is none.
PRELIGHT_INLINE float4 sampleLayer(PathScene s, uint layer, uint triangle, float u, float v) {
#ifdef PRELIGHT_LAYER_TEXTURES
  __global const DeviceMaterial* m = s.layers + PRELIGHT_LAYERS * materialAt(s.surface, triangle) + layer;
  if (m->texelOffset != PRELIGHT_NO_TEXTURE) {
    Surface texels = s.surface;
    texels.texels = s.layerTexels;
    return sampleTexture(texels, m, vertexTexCoord(s, triangle, u, v));
  }
#endif
  return (float4)(1.0f);
}

// Light leaves an emissive triangle on this side.
PRELIGHT_INLINE bool emitsOn(__global const ShadeMaterial* m, bool front) {
  return front || (m->flags & PRELIGHT_DOUBLE_SIDED) != 0u;
}

// Radiance that a point of a triangle sends out.
PRELIGHT_INLINE float3 emittedRadiance(PathScene s, uint triangle, float u, float v, bool front) {
  __global const ShadeMaterial* m = s.materials + materialAt(s.surface, triangle);
  if (!emitsOn(m, front)) return (float3)(0.0f);
  return vload3(0, m->emission) * sampleLayer(s, PRELIGHT_LAYER_EMISSION, triangle, u, v).xyz;
}

// Factor, texture and vertex colour of a point.
PRELIGHT_INLINE float3 baseColor(PathScene s, uint triangle, float u, float v) {
  return clamp(surfaceColor(s.surface, triangle, u, v).xyz * sampleLayer(s, PRELIGHT_LAYER_BASE, triangle, u, v).xyz,
               0.0f, 1.0f);
}

#ifdef PRELIGHT_TRANSLUCENT
// Divides the body's light between its two sides. `opaque`: share of the surface that is neither metal nor glass.
// What the layer keeps from leaving is scattered again: of the light that has entered, as much comes through as the
// material says. So the layer's mean passage, which evaluateBsdf takes off on the way out, is made up for.
PRELIGHT_INLINE void setTransmitted(__global const DeviceMaterial* layer, float opaque, Bsdf* b) {
  const float share = layer->alphaFactor;
  b->diffuse *= 1.0f - share;
  b->transmitted = fmin(vload3(0, layer->albedo), opaque * share) / fmax(1.0f - largest(meanLayer(*b)), 1e-6f);
}
#endif

PRELIGHT_INLINE Bsdf loadBsdf(PathScene s, Interaction i) {
  __global const ShadeMaterial* m = s.materials + i.material;
  const float4 layer = sampleLayer(s, PRELIGHT_LAYER_SURFACE, i.triangle, i.u, i.v);
  const float3 base = baseColor(s, i.triangle, i.u, i.v) * ((i.flags & PRELIGHT_UNLIT) != 0u ? 0.0f : 1.0f);
  const float metallic = m->metallic * layer.z;
  const float roughness = m->roughness * layer.y;
  const float opaque = (1.0f - metallic) * (1.0f - m->transmission);
  Bsdf b;
  b.diffuse = opaque * base;
  b.metal = metallic * base;
  b.f0 = vload3(0, m->f0);
  b.f90 = m->f90;
  b.layer = m->f90 > 0.0f ? opaque : 0.0f;
  b.glass = (i.flags & PRELIGHT_UNLIT) != 0u ? 0.0f : (1.0f - metallic) * m->transmission;
  b.tint = base;
  b.ior = m->ior;
  b.alpha = roughness * roughness;
  b.smooth = roughness < PRELIGHT_SMOOTH_BELOW;
#ifdef PRELIGHT_TRANSLUCENT
  setTransmitted(s.layers + PRELIGHT_LAYERS * i.material + PRELIGHT_LAYER_THROUGH, opaque, &b);
#endif
  return b;
}

#endif
