// Light of a vertex through its occluders, in OpenCL C and in GLSL (docs/notes/occluders.md).
#ifndef PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_SHADE_FUNCS_CL
#define PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_SHADE_FUNCS_CL

#include "techniques/vector_occluders/occluder_receiver_funcs.cl"
#include "techniques/vector_occluders/occluder_record_funcs.cl"

#define MOST_MAGNIFICATION 32.0f  // bound of the magnification of light by the thesis' caustics

// Constants of the soft formula.
#define FRONT_DEPTH 0.2f
#define ENCLOSURE 0.55f

// Sums over the lights of a vertex.
STRUCT_NAME(ShadeSums)
struct ShadeSums {
  vec3 diffuse;
  vec3 specular;
  vec3 reflected;
  float highlights;      // specular reflection of all lights
  float openHighlights;  // highlights without shadows
};

// Effect of a vertex' records on a light.
STRUCT_NAME(ShadowSums)
struct ShadowSums {
  vec3 hidden;       // blobs
  vec3 aroundBehind; // form factors of occluders that lie in front of the light
  vec3 passed;       // product of the thesis' factors
};

// Returns 0 where the light lies in front of an occluder and 1 where it lies behind: behind its plane for flat
// occluders, behind its mean distance for others.
float gateOf(vec4 facing, vec4 place, vec3 position, ArrivingLight light) {
  if (light.distance < 0.0f) return 1.0f;
  float byPlane = (dot(facing.xyz, place.xyz - position) - dot(facing.xyz, light.toLight) * light.distance) / place.w;
  float byDistance = light.distance / place.w - 1.0f;
  return clamp((facing.w * byPlane + (1.0f - facing.w) * byDistance) / FRONT_DEPTH, 0.0f, 1.0f);
}

// Returns the share of the light that an occluder hides: a blob around its mean direction.
float blobAt(vec4 direction, vec4 facing, vec4 blob, vec3 toLight) {
  float along = dot(direction.xyz, toLight);
  float across = dot(facing.xyz, toLight) - blob.w * along;
  float reach = (oneMinusCosine(direction.xyz, toLight) + blob.z * across * across) * blob.x;
  return blob.y * expOf(-min(reach, 60.0f));
}

// Returns the darkness for a sum of blobs.
vec3 shadowOf(vec3 sum) {
  vec3 x = clamp((sum - VEC3(SHADOW_BEGINS)) / (SHADOW_IS_WHOLE - SHADOW_BEGINS), 0.0f, 1.0f);
  return x * x * (VEC3(3.0f) - 2.0f * x);
}

// Returns the visibility from the sums of the soft formula. `closed`: the sixth power of the sum of form factors.
vec3 softVisibilityOf(ShadowSums sums, float closed) {
  return VEC3(1.0f) - shadowOf(sums.hidden + ENCLOSURE * closed * sums.aroundBehind);
}

// Returns the squared sine of an acute angle, or 1 beyond a right angle.
float acuteSine2(vec3 direction, vec3 toLight) {
  float cosine = clamp(dot(direction, toLight), 0.0f, 1.0f);
  float sine = length(cross(direction, toLight));
  return cosine > 0.0f ? min(sine * sine, 1.0f) : 1.0f;
}

// Sherif 2013, Eq. 7.2 and 7.3: the factor of an opaque occluder, which hides light, or of a clear one, which also
// focuses it.
vec3 thesisFactor(vec4 direction, TEXELS prepared, int at, vec3 toLight, OccluderTerms terms) {
  float blockage = dot(direction.xyz, direction.xyz) > 0.5f
                       ? powerOf(acuteSine2(direction.xyz, toLight), terms.shadowStrength * direction.w)
                       : 1.0f;
  if ((terms.stored & (PRELIGHT_STORES_TRANSMISSIVE | PRELIGHT_STORES_CAUSTIC)) == 0) return VEC3(blockage);
  vec4 opacity = FETCH(prepared, at + 5);
  float magnified = 1.0f;
  if ((terms.stored & PRELIGHT_STORES_CAUSTIC) != 0) {
    vec4 caustic = FETCH(prepared, at + 6);
    float scale = FETCH(prepared, at + 7).w;
    if (caustic.w > 0.0f && dot(caustic.xyz, caustic.xyz) > 0.5f) {
      float sine2 = max(acuteSine2(caustic.xyz, toLight), 1.0f / (MOST_MAGNIFICATION * MOST_MAGNIFICATION));
      magnified = 1.0f + scale * (exp2Of(-caustic.w * log2Of(sine2)) - 1.0f);
    }
  }
  return blockage * opacity.xyz + magnified * (VEC3(1.0f) - opacity.xyz);
}

ShadowSums withShadow(ShadowSums sums, TEXELS prepared, int at, vec4 direction, vec4 facing, vec4 place,
                      LitReceiver receiver, ArrivingLight light, OccluderTerms terms) {
  if (terms.thesisFormula != 0) {
    sums.passed = min(sums.passed * thesisFactor(direction, prepared, at, light.toLight, terms), MOST_MAGNIFICATION);
    return sums;
  }
  float gate = gateOf(facing, place, receiver.position, light);
  vec3 blob = VEC3(blobAt(direction, facing, FETCH(prepared, at + 3), light.toLight));
  vec3 around = VEC3(gate * direction.w);
  if ((terms.stored & (PRELIGHT_STORES_TRANSMISSIVE | PRELIGHT_STORES_CAUSTIC)) != 0) {
    // A clear occluder by itself is never darker than its opacity.
    vec3 level = FETCH(prepared, at + 5).xyz;
    blob = min(blob, level);
    around *= shadowOf(level);
  }
  sums.hidden += gate * blob;
  sums.aroundBehind += around;
  return sums;
}

// The mirroring part of a prepared record.
STRUCT_NAME(ArrivingMirror)
struct ArrivingMirror {
  vec4 way;
  vec4 normal;
  vec4 reflectance;
};

bool showsMirrors(LitReceiver receiver, OccluderTerms terms) {
  return terms.specularFromSpecular > 0.0f && isGlossy(receiver);
}

ShadeSums withMirrorLobe(ShadeSums sums, ArrivingMirror mirror, vec3 direction, LitReceiver receiver, ArrivingLight there,
                         OccluderTerms terms) {
  vec3 sent = mirror.reflectance.xyz * there.irradiance;
  sums.diffuse +=
      terms.diffuseFromSpecular * mirror.way.w * cosineLobe(mirror.normal.w, dot(mirror.way.xyz, there.toLight)) * sent;
  if (!showsMirrors(receiver, terms)) return sums;
  // Computes the share of the receiver's lobe that the mirror fills; the reflected eye direction is then reflected
  // again at the mirror.
  vec3 look = mirroredAbout(-receiver.toEye, receiver.normal);
  float alpha = max(receiver.roughness * receiver.roughness, LEAST_ALPHA);
  float solidAngle = OCCLUDER_PI * mirror.way.w / (max(dot(receiver.normal, direction), 0.0f) + HORIZON_SLACK);
  float exponent = 1.0f / (0.5f * alpha * alpha + mirror.reflectance.w + 1e-3f);
  float share = min(solidAngle * cosineLobe(exponent, dot(look, direction)), 1.0f);
  vec3 fresnel = fresnelOf(receiver.f0, max(dot(receiver.normal, receiver.toEye), 0.0f));
  float aligned = cosineLobe(mirror.normal.w, dot(mirroredAbout(look, mirror.normal.xyz), there.toLight));
  sums.reflected += terms.specularFromSpecular * share * aligned * fresnel * sent;
  return sums;
}

// Sherif 2013, listing A.2. Diffuse from specular: the mirror's weight is within the power. Specular from specular:
// depends on how closely the reflected eye direction meets the mirror, less strictly the larger the mirror is.
ShadeSums withThesisMirror(ShadeSums sums, ArrivingMirror mirror, LitReceiver receiver, ArrivingLight there,
                           OccluderTerms terms) {
  float weight = mirror.way.w;
  if (weight <= 0.0f) return sums;
  vec3 sent = mirror.reflectance.xyz * there.irradiance / OCCLUDER_PI;
  float aligned = weight * clamp(dot(mirror.way.xyz, there.toLight), 0.0f, 1.0f);
  sums.diffuse += terms.diffuseFromSpecular * powerOf(aligned, mirror.normal.w) * sent;
  if (!showsMirrors(receiver, terms)) return sums;
  vec3 look = mirroredAbout(-receiver.toEye, receiver.normal);
  vec3 toMirror = mirroredAbout(mirror.way.xyz, mirror.normal.xyz);
  float looksThere = powerOf(clamp(dot(toMirror, look), 0.0f, 1.0f), 1.0f - weight);
  float again = clamp(dot(mirroredAbout(look, mirror.normal.xyz), there.toLight), 0.0f, 1.0f);
  sums.reflected += terms.specularFromSpecular * powerOf(looksThere * again, mirror.normal.w) * receiver.f0 * sent;
  return sums;
}

// Adds light that an occluder's visible part sends to the vertex, given the light that arrives there: diffusely
// reflected (form factor and AO are in the normal), let through and mirrored.
ShadeSums withIndirect(ShadeSums sums, TEXELS prepared, int at, vec4 facing, vec3 direction, LitReceiver receiver,
                       ArrivingLight there, OccluderTerms terms) {
  vec4 color = FETCH(prepared, at + 4);
  float facingLight = color.w * max(dot(facing.xyz, there.toLight), 0.0f);
  sums.diffuse += terms.bleeding * facingLight / OCCLUDER_PI * color.xyz * there.irradiance;
  int next = at + 5;
  if ((terms.stored & (PRELIGHT_STORES_TRANSMISSIVE | PRELIGHT_STORES_CAUSTIC)) != 0) {
    if ((terms.stored & PRELIGHT_STORES_CAUSTIC) != 0 && terms.thesisFormula == 0) {
      vec4 caustic = FETCH(prepared, at + 6);
      float density = FETCH(prepared, at + 5).w * expOf(-caustic.w * oneMinusCosine(caustic.xyz, there.toLight));
      sums.diffuse += terms.causticStrength * density * FETCH(prepared, at + 7).xyz * there.irradiance;
    }
    next += 3;
  }
  if ((terms.stored & PRELIGHT_STORES_SPECULAR) == 0) return sums;
  ArrivingMirror mirror;
  mirror.way = FETCH(prepared, next);
  mirror.normal = FETCH(prepared, next + 1);
  mirror.reflectance = FETCH(prepared, next + 2);
  if (terms.thesisMirrors != 0) return withThesisMirror(sums, mirror, receiver, there, terms);
  return withMirrorLobe(sums, mirror, direction, receiver, there, terms);
}

ShadeSums withDirect(ShadeSums sums, LitReceiver receiver, SceneLight light, ArrivingLight arriving, vec3 visibility,
                     OccluderTerms terms) {
  float cosine = max(dot(receiver.normal, arriving.toLight), 0.0f);
  vec3 irradiance = cosine * arriving.irradiance;
  vec3 reached = irradiance * visibility;
  float rough = terms.orenNayar != 0 ? roughDiffuse(receiver, arriving.toLight) : 1.0f;
  sums.diffuse += rough / OCCLUDER_PI * reached;
  if (light.cone.z < 0.5f || !isGlossy(receiver)) return sums;
  sums.specular += glossyReflection(receiver, arriving.toLight) * reached;
  float shine = microfacets(receiver, arriving.toLight, LEAST_SHARE_ALPHA);
  vec3 open = irradiance / max(light.flicker, VEC3(1e-6f));
  sums.highlights += shine * (reached.x + reached.y + reached.z);
  sums.openHighlights += shine * (open.x + open.y + open.z);
  return sums;
}

// Adds one light. The vertex' records are `first` to before `end`.
ShadeSums litBy(ShadeSums sums, TEXELS prepared, int first, int end, float closed, LitReceiver receiver, SceneLight light,
                OccluderTerms terms) {
  ArrivingLight arriving = arrivingAt(light, receiver.position);
  bool faces = dot(receiver.normal, arriving.toLight) > 0.0f;
  ShadowSums shadow;
  shadow.hidden = VEC3(0.0f);
  shadow.aroundBehind = VEC3(0.0f);
  shadow.passed = VEC3(1.0f);
  for (int record = first; record < end; ++record) {
    int at = record * terms.stride;
    vec4 direction = FETCH(prepared, at);
    vec4 facing = FETCH(prepared, at + 1);
    vec4 place = FETCH(prepared, at + 2);
    if (faces && direction.w > 0.0f)
      shadow = withShadow(shadow, prepared, at, direction, facing, place, receiver, arriving, terms);
    sums = withIndirect(sums, prepared, at, facing, direction.xyz, receiver, arrivingAt(light, place.xyz), terms);
  }
  if (!faces) return sums;
  vec3 visibility = terms.thesisFormula != 0 ? shadow.passed : softVisibilityOf(shadow, closed);
  return withDirect(sums, receiver, light, arriving, visibility, terms);
}

// Returns the sums over all lights of a vertex.
ShadeSums litVertex(TEXELS prepared, int first, int end, TEXELS lights, TEXELS waves, LitReceiver receiver,
                    OccluderTerms terms) {
  ShadeSums sums;
  sums.diffuse = VEC3(0.0f);
  sums.specular = VEC3(0.0f);
  sums.reflected = VEC3(0.0f);
  sums.highlights = 0.0f;
  sums.openHighlights = 0.0f;
  if (terms.normalWaves > 0.0f)
    receiver.normal = bentBy(receiver.normal, displacementAt(waves, receiver.position, terms), terms.normalWaves);
  float around = 0.0f;
  for (int record = first; record < end; ++record) around += FETCH(prepared, record * terms.stride).w;
  float closed = min(around, 1.0f);
  closed = closed * closed * closed;
  closed = closed * closed;
  for (int light = 0; light < terms.lightCount; ++light)
    sums = litBy(sums, prepared, first, end, closed, receiver, readLight(lights, waves, light, terms), terms);
  sums.diffuse = max(sums.diffuse, VEC3(0.0f));  // bleeding may be negative
  return sums;
}

// Returns the share of the highlights that shadows leave.
float highlightShare(ShadeSums sums) {
  return sums.openHighlights > 0.0f ? sums.highlights / sums.openHighlights : 1.0f;
}

#endif
