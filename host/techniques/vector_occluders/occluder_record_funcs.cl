// Records of vector occluders as shading reads them, in OpenCL C and in GLSL: all terms that do not depend on the light
// are computed once per record (docs/notes/occluders.md).
#ifndef PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_RECORD_FUNCS_CL
#define PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_RECORD_FUNCS_CL

#include "techniques/vector_occluders/occluder_wave_funcs.cl"

#define MOST_CONCENTRATION 100.0f     // greatest kappa of a caustic: half of the light within 6.8 degrees of the middle
#define MOST_CAUSTIC_EXPONENT 0.5f    // greatest exponent of the thesis' formula for which its integral is finite
#define HORIZON_SLACK 0.1f            // between form factor and solid angle at the horizon

// A record as it is stored; absent parts are zero.
STRUCT_NAME(StoredRecord)
struct StoredRecord {
  vec4 position;
  vec4 occlusion;
  vec4 caustic;
  vec4 transmissive;
  vec4 normal;
  vec4 color;
  vec4 mirrorNormal;
  vec4 mirrorColor;
};

// A record prepared for shading. The first five members are always stored, the next three where light comes through,
// the last three where something mirrors.
STRUCT_NAME(PreparedRecord)
struct PreparedRecord {
  vec4 direction;     // mean direction; form factor
  vec4 facing;        // mean normal; planarity in [0, 1]
  vec4 place;         // mean place; mean distance
  vec4 blob;          // sharpness, height, stretch, cosine between direction and normal
  vec4 color;         // diffuse albedo; weight of the normals
  // Greatest value that the blob may take, or opacity in the thesis' formula; peak of the caustic's lobe.
  vec4 opacity;
  vec4 caustic;       // mean direction; concentration, or exponent of the thesis
  vec4 carried;       // light that comes through, form factor x colour; scale of the thesis' excess
  vec4 mirrored;      // mean direction that is mirrored to the receiver; form factor, or length of the sum of normals
  vec4 mirrorNormal;  // mean normal of what mirrors; exponent
  vec4 mirrorColor;   // reflectance; 1 - mean resultant length of the directions
};

StoredRecord readRecord(TEXELS records, int record, OccluderTerms terms) {
  bool hasCaustic = (terms.stored & PRELIGHT_STORES_CAUSTIC) != 0;
  bool hasTransmissive = (terms.stored & PRELIGHT_STORES_TRANSMISSIVE) != 0;
  bool hasSpecular = (terms.stored & PRELIGHT_STORES_SPECULAR) != 0;
  int at = record * (4 + (hasCaustic ? 1 : 0) + (hasTransmissive ? 1 : 0) + (hasSpecular ? 2 : 0));
  StoredRecord result;
  result.position = FETCH(records, at);
  result.occlusion = FETCH(records, at + 1);
  at += 2;
  result.caustic = VEC4(0.0f);
  if (hasCaustic) result.caustic = FETCH(records, at);
  at += hasCaustic ? 1 : 0;
  result.transmissive = VEC4(0.0f);
  if (hasTransmissive) result.transmissive = FETCH(records, at);
  at += hasTransmissive ? 1 : 0;
  result.normal = FETCH(records, at);
  result.color = FETCH(records, at + 1);
  at += 2;
  result.mirrorNormal = VEC4(0.0f);
  result.mirrorColor = VEC4(0.0f);
  if (hasSpecular) {
    result.mirrorNormal = FETCH(records, at);
    result.mirrorColor = FETCH(records, at + 1);
  }
  return result;
}

// Constants of the soft formula, which were fitted (docs/notes/occluders.md).
#define WIDTH_OF_SPREAD 0.77f
#define WIDTH_OF_SIZE 0.17f
#define LEAST_WIDTH 1e-4f
#define BLOB_HEIGHT 0.55f
#define MOST_BLOB_HEIGHT 2.0f
#define FLAT_SHARE 0.95f
#define FACING_GAIN 3.0f
#define SHADOW_BEGINS 0.075f  // sum of blobs
#define SHADOW_IS_WHOLE 0.65f
#define OPAQUE 0.99999f

// Returns sharpness, height and stretch of an occluder's blob, and the cosine between direction and normal.
vec4 blobOf(float formFactor, float resultant, vec3 direction, vec3 normal, float flatness, vec3 receiverNormal) {
  float size = formFactor / (max(dot(receiverNormal, direction), 0.0f) + HORIZON_SLACK);
  float width = WIDTH_OF_SPREAD * (1.0f - resultant) + WIDTH_OF_SIZE * size + LEAST_WIDTH;
  // AO damps the normals of precisely the parts that lie close, so their resultant length says little about flatness.
  float share = flatness > 0.0f ? FLAT_SHARE : 0.0f;
  float cosine = dot(normal, direction);
  float foreshortening = 1.001f - share * (1.0f - cosine * cosine);
  return VEC4(sqrt(foreshortening) / width, min(MOST_BLOB_HEIGHT, BLOB_HEIGHT * size / width),
              0.5f * share / foreshortening, cosine);
}

// Returns the concentration kappa of the von Mises-Fisher lobe of light that comes through, from the mean resultant
// length of its directions ([1] Banerjee et al., "Clustering on the unit hypersphere using von Mises-Fisher
// distributions", 2005, Eq. 4.4).
float concentrationOf(float resultant) {
  float kappa = resultant * (3.0f - resultant * resultant) / max(1.0f - resultant * resultant, 1e-4f);
  return clamp(kappa, 1e-2f, MOST_CONCENTRATION);
}

// Returns the sum of blobs at which the soft formula's shadow is as dark as an opacity: the inverse of its smoothstep,
// by bisection. Opaque occluders have no such level.
vec3 shadowLevelOf(vec3 opacity) {
  vec3 x = VEC3(0.5f);
  float halved = 0.25f;
  for (int i = 0; i < 22; ++i) {
    vec3 above = x * x * (VEC3(3.0f) - 2.0f * x) - opacity;
    x -= halved * VEC3(above.x > 0.0f ? 1.0f : -1.0f, above.y > 0.0f ? 1.0f : -1.0f, above.z > 0.0f ? 1.0f : -1.0f);
    halved *= 0.5f;
  }
  vec3 level = VEC3(SHADOW_BEGINS) + (SHADOW_IS_WHOLE - SHADOW_BEGINS) * x;
  return VEC3(opacity.x < OPAQUE ? level.x : MOST_BLOB_HEIGHT, opacity.y < OPAQUE ? level.y : MOST_BLOB_HEIGHT,
              opacity.z < OPAQUE ? level.z : MOST_BLOB_HEIGHT);
}

// Fills the part of a record that describes light coming through the occluder.
PreparedRecord withThrough(PreparedRecord prepared, StoredRecord record, OccluderTerms terms) {
  bool hasCaustic = (terms.stored & PRELIGHT_STORES_CAUSTIC) != 0;
  bool hasTransmissive = (terms.stored & PRELIGHT_STORES_TRANSMISSIVE) != 0;
  float share = record.caustic.w;
  // Without stored colours, light that comes through is white.
  vec3 colour = VEC3(min(share / max(record.occlusion.w, 1e-9f), 1.0f));
  if (hasTransmissive) colour = clamp(record.transmissive.xyz, 0.0f, 1.0f);
  vec3 direction = unitOf(record.caustic.xyz);
  float resultant = resultantOf(record.caustic);
  if (terms.thesisFormula != 0) {
    // Eq. 7.3 minus 1, scaled so that its cosine-weighted mean over the hemisphere does not exceed the share.
    float exponent = min(terms.causticStrength * share, MOST_CAUSTIC_EXPONENT);
    float excess = exponent / (1.0f - exponent);
    prepared.opacity = VEC4(VEC3(1.0f) - colour, 0.0f);
    prepared.caustic = VEC4(direction, exponent);
    prepared.carried = VEC4(0.0f, 0.0f, 0.0f, excess > share ? share / excess : 1.0f);
    return prepared;
  }
  // Light that follows the caustic does not also go straight through.
  float straight = hasCaustic ? max(1.0f - terms.causticStrength, 0.0f) : 1.0f;
  float kappa = concentrationOf(resultant);
  prepared.opacity = VEC4(shadowLevelOf(VEC3(1.0f) - straight * colour), hasCaustic ? vonMisesFisherPeak(kappa) : 0.0f);
  prepared.caustic = VEC4(direction, kappa);
  prepared.carried = VEC4(record.occlusion.w * colour, 0.0f);
  return prepared;
}

// Fills the part of a record that mirrors. The width of its lobe adds up the exponent's, that of the mirror's size, and
// that of the variation of its normals: a normal that deviates by an angle deflects the reflection by twice that, so
// that 1 - cosine grows by four.
PreparedRecord withMirror(PreparedRecord prepared, StoredRecord record, vec3 place, OccluderTerms terms) {
  vec3 normal = unitOf(record.mirrorNormal.xyz);
  vec3 way = unitOf(record.position.xyz - place);
  float spread = 1.0f - resultantOf(record.occlusion);
  float bent = 1.0f - resultantOf(record.mirrorNormal);
  float exponent = 1.0f / (1.0f / max(terms.specularExponent, 1.0f) + spread + 4.0f * bent);
  float weight = record.mirrorNormal.w;
  if (terms.thesisMirrors != 0) {
    weight = min(sqrt(dot(record.mirrorNormal.xyz, record.mirrorNormal.xyz)), 1.0f);
    exponent = max(terms.specularExponent, 1.0f);
  }
  prepared.mirrored = VEC4(mirroredAbout(way, normal), weight);
  prepared.mirrorNormal = VEC4(normal, exponent);
  prepared.mirrorColor = VEC4(clamp(record.mirrorColor.xyz, 0.0f, 1.0f), spread);
  return prepared;
}

PreparedRecord preparedFrom(StoredRecord record, vec3 place, vec3 receiverNormal, TEXELS waves, OccluderTerms terms) {
  PreparedRecord prepared;
  vec3 normal = unitOf(record.normal.xyz);
  float flatness = resultantOf(record.normal);
  float resultant = resultantOf(record.occlusion);
  vec3 bend = VEC3(0.0f);
  if (terms.waves > 0.0f || terms.normalWaves > 0.0f) bend = displacementAt(waves, place, terms);
  vec3 direction = bentBy(unitOf(record.occlusion.xyz), bend, terms.waves);
  receiverNormal = bentBy(receiverNormal, bend, terms.normalWaves);
  // AO removes parts that touch the receiver from the normals; a visible plane faces its viewer.
  float plane = flatness * clamp(-FACING_GAIN * dot(normal, direction), 0.0f, 1.0f);
  prepared.direction = VEC4(direction, max(record.occlusion.w, 0.0f));
  prepared.facing = VEC4(normal, plane);
  prepared.place = VEC4(record.position.xyz, max(record.position.w, 1e-9f));
  prepared.blob = blobOf(prepared.direction.w, resultant, direction, normal, flatness, receiverNormal);
  prepared.color = VEC4(record.color.xyz, sqrt(dot(record.normal.xyz, record.normal.xyz)));
  prepared.opacity = VEC4(1.0f, 1.0f, 1.0f, 0.0f);
  prepared.caustic = VEC4(0.0f);
  prepared.carried = VEC4(0.0f);
  prepared.mirrored = VEC4(0.0f);
  prepared.mirrorNormal = VEC4(0.0f);
  prepared.mirrorColor = VEC4(0.0f);
  if ((terms.stored & (PRELIGHT_STORES_TRANSMISSIVE | PRELIGHT_STORES_CAUSTIC)) != 0) {
    prepared = withThrough(prepared, record, terms);
    prepared.caustic = VEC4(bentBy(prepared.caustic.xyz, bend, terms.waves), prepared.caustic.w);
  }
  if ((terms.stored & PRELIGHT_STORES_SPECULAR) != 0) prepared = withMirror(prepared, record, place, terms);
  return prepared;
}

#endif
