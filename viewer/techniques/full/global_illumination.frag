#version 410 core
// A surface under all light: lights with the shadows of their maps, indirect light of a light map or of virtual lights,
// caustics; mirrors and glass show their surroundings.
#include "frame.glsl"
#include "variant.glsl"
#include "parts.glsl"
#include "lights.glsl"
#include "material.glsl"
#include "triangles.glsl"
#include "normal_map.glsl"
#include "anisotropy.glsl"

const bool layerCovers = hasLayer;
const bool bouncesLater = hasGloss || hasLayer;
#include "scattering.glsl"
#include "top_layers.glsl"
#include "glass_lobe.glsl"
#include "sky.glsl"
#include "light_map.glsl"
#include "shadows.glsl"
#include "surroundings.glsl"

in vec3 vPosition;
in vec3 vNormal;
in vec4 vTexCoords;
in vec4 vColor;

uniform sampler2D caustics;   // irradiance of every pixel
uniform ivec4 causticCorner;  // xy: of this picture in theirs; w: samples a pixel of this one, 0 where there are none
uniform int showsSurroundings;  // 1: the surface reflects as mirrors do what lies around it
#include "rough_glass.glsl"
#include "ambient.glsl"

layout(location = 0, index = 0) out vec4 outRadiance;     // alpha: distance from the eye
layout(location = 0, index = 1) out vec4 outTransmitted;  // factor of what lies behind

// A light's share: scattered radiance of its irradiance with its shadow. `lobes`: shares of what the surface's lobe and its
// coat's reflect.
vec3 shadeLight(int k, Scattering s, TopLayers top, Normals normals, vec3 toEye, vec2 lobes, int reach) {
  vec3 toLight;
  vec3 irradiance = perpendicularIrradiance(lights[k], vPosition, toLight);
  vec3 n = normals.reflecting, geometric = normals.geometric;
  float nl = dot(n, toLight);
  float onBody = hasNormalTexture ? dot(normals.bumped, toLight) : nl;
  float side = dot(geometric, toLight);
  if (largest(irradiance) <= 0.0) return vec3(0.0);
  float nv = max(dot(n, toEye), 0.0);
  float left = leftByLayers(top, max(dot(top.coatNormal, toEye), 0.0), nv);
  vec3 wo = vec3(inFrame(s, n, toEye).xy, nv);
  vec3 wi = inFrame(s, n, toLight);
  vec3 intoBody = hasNormalTexture && !isAnisotropic(s) ? vec3(0.0, 0.0, abs(onBody)) : wi;
  bool onGlass = isRoughGlass(s) && k < counts.y;  // samples of large lights are seen around it
  if (onGlass && solidGlass == 0 && nl < 0.0 && side < 0.0) {
    vec3 passing = shareBlurred(s.roughness) * roughGlassOfLight(s, n, toEye, toLight);
    if (hasTranslucency && translucency.a > 0.0) passing += transmittedOfLight(s, wo, intoBody) * max(-onBody, 0.0);
    return left * passing * irradiance * visibility(k, vPosition, -geometric, reach);
  }
  if (hasTranslucency && translucency.a > 0.0 && onBody < 0.0 && side < 0.0)
    return left * transmittedOfLight(s, wo, intoBody) * irradiance * -onBody * visibility(k, vPosition, -geometric, reach);
  if (max(nl, onBody) <= 0.0 || side <= 0.0) return vec3(0.0);
  vec3 reflected = diffuseOfLight(s, wo, intoBody);
  if (hasNormalTexture) {  // the body has a normal of its own
    reflected *= max(onBody, 0.0);
    if (nl > 0.0 && lobes.x > 0.0) reflected += nl * lobes.x * glossyOfLight(s, n, toEye, toLight);
    if (nl > 0.0 && onGlass) reflected += roughGlassOfLight(s, n, toEye, toLight);
    reflected *= left;
    if (nl > 0.0 && hasTopLayers) reflected += layersOfLight(top, n, toEye, toLight, lobes.y);
    return reflected * irradiance * visibility(k, vPosition, geometric, reach);
  }
  if (lobes.x > 0.0) reflected += lobes.x * glossyOfLight(s, n, toEye, toLight);
  if (onGlass) reflected += roughGlassOfLight(s, n, toEye, toLight) / nl;
  if (!hasTopLayers) return reflected * irradiance * nl * visibility(k, vPosition, geometric, reach);
  reflected = reflected * nl * left + layersOfLight(top, n, toEye, toLight, lobes.y);
  return reflected * irradiance * visibility(k, vPosition, geometric, reach);
}

// `shown`: shares of what the surface's lobe and its coat's reflect that the surroundings show, with large lights and the sky
// among them.
vec3 shadeLights(Scattering s, TopLayers top, Normals n, vec3 toEye, vec2 shown) {
  vec3 sum = vec3(0.0);
  bool reflects = (hasGloss || hasLayer) && largest(s.f90) > 0.0 && s.roughness >= smoothBelow;
  vec2 lobes = vec2(reflects ? 1.0 : 0.0, 1.0);
  // Lamps whose number is known are read once for all pixels.
  if (lampCount > 0) sum += shadeLight(0, s, top, n, toEye, lobes, 1);
  if (lampCount > 1) sum += shadeLight(1, s, top, n, toEye, lobes, 1);
  if (lampCount > 2) sum += shadeLight(2, s, top, n, toEye, lobes, 1);
  if (lampCount > 3) sum += shadeLight(3, s, top, n, toEye, lobes, 1);
  if (lampCount < 0)
    for (int k = 0; k < counts.y; ++k) sum += shadeLight(k, s, top, n, toEye, lobes, 1);
  // Pixels take turns with the samples of large lights (Keller and Heidrich 2001, interleaved sampling): those that a
  // pixel of the picture is the mean of have all of them.
  ivec2 turn = ivec2(gl_FragCoord.xy) % counts.z;
  int stride = counts.z * counts.z;
  vec3 samples = vec3(0.0);
  for (int k = counts.y + turn.x + counts.z * turn.y; k < counts.x; k += stride)
    samples += shadeLight(k, s, top, n, toEye, lobes * (vec2(1.0) - shown), 0);
  return sum + float(stride) * samples;
}

// What comes through a body along the way to the eye, less what it absorbs.
vec3 seenThroughBody(vec3 n, vec3 toEye) {
  vec3 passed;
  if (!hasDispersion || dispersion <= 0.0) {
    vec3 seen = radianceThroughBody(vPosition, n, toEye, glassIor, absorption, passed);
    return passed * seen;
  }
  vec3 sum = vec3(0.0);
  for (int k = 0; k < waves; ++k) {
    float part = (float(k) + 0.5) / float(waves);
    float ior = iorOfWave(glassIor, dispersion, part);
    vec3 seen = radianceThroughBody(vPosition, n, toEye, ior, absorption, passed);
    sum += colorOfWave(part) * passed * seen;
  }
  return sum / float(waves);
}

// Shares of what the surface's lobe and its coat's reflect that the environment map shows. A map is sharp and seen from one
// place: wide lobes take their light from the samples and the mean of the place itself, and so does what the map's middle
// does not see. Bodies have narrower lobes from samples than metals, of which they are all.
vec2 shownBySurroundings(Scattering s, TopLayers top, float metallic) {
  if (!hasSurroundings || showsSurroundings == 0 || hiddenFromCube(vPosition)) return vec2(0.0);
  float wide = mix(smoothstep(0.2, 0.3, s.roughness), smoothstep(0.3, 0.5, s.roughness), metallic);
  return vec2(1.0 - wide, hasTopLayers ? 1.0 - smoothstep(0.2, 0.3, top.coatRoughness) : 0.0);
}

// What glass reflects; what it lets through where it has an inside or is rough, else the factor of what lies behind.
vec3 shadeGlass(Scattering s, vec3 n, vec3 toEye, float nv, out vec3 through) {
  vec3 reflected = glassReflectance(s, max(nv, 1e-6));
  if (solidGlass == 0) reflected = 2.0 * reflected / (1.0 + reflected);  // all the reflections between two faces
  bool hasInside = solidGlass != 0 && glassIor > 0.0;
  float blurred = !isRoughGlass(s) || glassIor <= 0.0 ? 0.0 : hasInside ? 1.0 : shareBlurred(s.roughness);
  vec3 radiance = vec3(0.0);
  if (blurred > 0.0) radiance = blurred * s.tint * seenThroughRoughGlass(s, n, toEye, reflected);
  through = (1.0 - largest(reflected)) * s.tint;
  if (hasInside && blurred == 0.0) radiance = through * seenThroughBody(n, toEye);
  if (hasInside) radiance *= s.tint;  // where it leaves, too
  radiance += reflected * surroundingRadiance(vPosition, reflect(-toEye, n), s.roughness);
  through *= hasInside ? 0.0 : s.glass * (1.0 - blurred);
  return s.glass * radiance;
}

void main() {
  FragmentMaterial m = readMaterial(vTexCoords, vColor);
  if (hasCutouts && m.alpha < surfaceFactors.w) discard;
  float alpha = hasBlending && alphaBlend != 0 ? clamp(m.alpha, 0.0, 1.0) : 1.0;
  outTransmitted = vec4(vec3(1.0 - alpha), 1.0);
  if (hasUnlit && unlit != 0) {
    outRadiance = vec4(partShown(partEmitted, m.base * alpha), distance(eye.xyz, vPosition));
    return;
  }
  int triangle = firstTriangle + gl_PrimitiveID;
  vec4 geometry = texelFetch(triangleNormals, triangle);
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 geometric = side * geometry.xyz;
  bool smoothShaded = geometry.w < 0.5 && dot(vNormal, vNormal) > 1e-12;
  vec3 n = smoothShaded ? side * normalize(vNormal) : geometric;
  vec3 toEye = eye.w > 0.5 ? normalize(eye.xyz - vPosition) : -forward.xyz;
  vec3 even = n;
  vec3 bumped = bumpedNormal(even, vPosition, triangle, vTexCoords);
  n = reflectingNormal(bumped, geometric, toEye);
  float nv = max(dot(n, toEye), 0.0);
  TopLayers top = readTopLayers(vTexCoords, even, geometric, toEye, vPosition, triangle);
  Scattering s = scatteringOf(m, readStretch(vTexCoords, even, n, vPosition, triangle), hasLayer);
  if (hasFilm) addFilm(vTexCoords, top.coat, m, s);
  vec3 wo = vec3(inFrame(s, n, toEye).xy, nv);
  float onCoat = max(dot(top.coatNormal, toEye), 0.0);
  float coated = hasTopLayers ? coatAlbedo(top, onCoat) : 0.0;

  vec3 indirect = indirectIrradiance(triangle, gl_FrontFacing, bumped, geometric);
  vec3 irradiance = partShown(partIndirect, indirect);
  if (hasCaustics && causticCorner.w != 0)
    irradiance += partShown(partCaustic, texelFetch(caustics, ivec2(gl_FragCoord.xy) / causticCorner.w + causticCorner.xy, 0).rgb);
  float left = leftByLayers(top, onCoat, nv);
  vec2 shown = shownBySurroundings(s, top, m.metallic);
  vec3 radiance = partShown(partEmitted, m.emission * (1.0 - coated)) + left * diffuseOfIrradiance(s, wo) * irradiance +
                  partShown(partDirect, shadeLights(s, top, Normals(geometric, bumped, n), toEye, shown));
  if (hasTranslucency && translucency.a > 0.0) {
    vec3 beyond = indirectIrradiance(triangle, !gl_FrontFacing, -bumped, -geometric);
    radiance += partShown(partIndirect, left * transmittedOfIrradiance(s, wo) * beyond);
  }
  // What lies around is not known elsewhere but for the mean of its radiance.
  vec3 around = indirect / pi, onCoatAround = indirect / pi;
  if (hasSurroundings && shown.x > 0.0) {
    vec3 seen = isAnisotropic(s) ? surroundingStretched(vPosition, n, toEye, s.along, s.widths)
                                 : surroundingRadiance(vPosition, reflect(-toEye, n), s.roughness);
    around = mix(around, seen, shown.x);
  }
  if (hasSurroundings && shown.y > 0.0)
    onCoatAround = mix(onCoatAround, surroundingRadiance(vPosition, reflect(-toEye, top.coatNormal), top.coatRoughness), shown.y);
  radiance += partShown(partReflected, left * reflectanceOfSurroundings(s, wo) * around);
  if (hasTopLayers) radiance += partShown(partReflected, coated * onCoatAround);
  if (hasTopLayers) radiance += partShown(partReflected, top.sheen * sheenAlbedo(top, nv) * (1.0 - coated) * indirect / pi);
  vec3 through = vec3(0.0);
  if (hasGlass && s.glass > 0.0) radiance += partShown(partReflected, left * shadeGlass(s, n, toEye, nv, through));
  through *= left;
  outRadiance = vec4(radiance * alpha, distance(eye.xyz, vPosition));
  outTransmitted = vec4(vec3(1.0 - alpha) + alpha * through, 1.0);
}
