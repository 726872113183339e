#version 410 core
// A surface in one of the shadings. Approximations, so that nothing looks dead or wrong:
// - metals have no diffuse albedo: they reflect lights (unshadowed, but for vector occluders, whose vertices know what
//   share of the lights' reflection shadows leave) and the sky, attenuated by the accessibility;
// - dielectrics whose layer reflects as metals do are mirrors as well, since specular-glossiness writes metals so;
// - transmissive surfaces are thin: what lies behind shows straight through, tinted, and they reflect the sky;
// - light comes through translucent surfaces where that of their other side is known: of lights without shadows, of a
//   light map, of the sky, and of transfer that was baked with that of other sides;
// - lights that a transfer cannot see rightly (viewer/lights/lighting.h) shine without shadows, but for lamps that have those of
//   shells of distance.
#include "frame.glsl"
#include "variant.glsl"
#include "parts.glsl"
#include "lights.glsl"
#include "material.glsl"
#include "specular.glsl"
#include "sky.glsl"
#include "cones.glsl"
#include "triangles.glsl"
#include "glossy.glsl"
#include "light_map.glsl"
#include "encoded_light.glsl"
#include "horizons.glsl"
#include "normal_map.glsl"
#include "shading_normal.glsl"
#include "surroundings.glsl"
#include "object_light.glsl"

in vec3 vPosition;
in vec3 vNormal;
in vec4 vTexCoords;
in vec3 vOpenness;
in vec4 vColor;
in float vAccessibility;
in vec4 vBentNormal;
in vec3 vTransferred;
in vec3 vGlow;
in vec4 vChartCoord;
in vec3 vReflected;
in float vHighlight;
in vec4 vLampVisibility[4];

uniform int knowsThrough;     // 1: vReflected is what arrives on the surface's other side
uniform sampler2D caustics;   // irradiance of every pixel
uniform ivec4 causticCorner;  // xy: of this picture in theirs; w: samples a pixel of this one, 0 where there are none
uniform sampler2D screenInput;  // openness of every sample, as shaders of screen-space occlusion write it
uniform sampler2D screenLamps, screenBounce;  // as screen_ssdo.frag writes them

#include "surface_output.glsl"

// Screen-space occlusion knows which light arrives; a sender shows no more than what it scatters of that.
const bool isSender = ambientRule == ambientSender;
const bool findsBounce = ambientRule == ambientScreenBounce;
const bool isLitByCube = ambientRule == ambientObjectCube;
const bool takesSuns = ambientRule == ambientCone || ambientRule == ambientHorizons;
const bool findsLight = ambientRule == ambientScreenLight || findsBounce || isSender;

// How far a layer's reflectance along the normal makes a mirror of a dielectric: diamond's, 0.17, not at all.
float mirrorShare(vec3 f0) { return clamp((max(f0.r, max(f0.g, f0.b)) - 0.2) / 0.3, 0.0, 1.0); }

// The cone of the side that has one, built once per fragment for all lamps.
OpenCone openCone() {
  if (ambientRule != ambientCone || !gl_FrontFacing || dot(vBentNormal.xyz, vBentNormal.xyz) <= 1e-12) return noCone();
  return coneAround(normalize(vBentNormal.xyz), clamp(vBentNormal.w, 0.0, 1.0), vAccessibility);
}

// n: of the side that is seen, without bumps.
Horizons horizonsHere(vec3 n) {
  if (ambientRule == ambientHorizons) {
    if (gl_FrontFacing) return horizonsAt(triangleHere(), vPosition, n);
  }
  return noHorizons();
}

// How much of the light from a direction arrives past what is around.
struct Visibility {
  OpenCone cone;
  Horizons horizons;
};

bool isTransferred(Light light) {
  return throughRule == throughAllLights || (throughRule == throughFarLights && isFar(light));
}

// What shells of distance leave of a near lamp's light: sharpened() of host/techniques/near_lamps/lamp_shells.h, as area lights are already. Backs
// have none.
float lampShadow(Light light) {
  if (isLitByCube) return reachesObject(light, vPosition) ? 1.0 : 0.0;
  int shadow = shadowOf(light);
  if (!hasNearLamps || shadow < 0 || !gl_FrontFacing) return 1.0;
  float visibility = vLampVisibility[shadow / 4][shadow % 4];
  return isArea(light) ? visibility : clamp(0.5 + 3.0 * (visibility - 0.5), 0.0, 1.0);
}

// Surfaces that do not show reflections of emissive surfaces sum their samples with fewer operations.
const bool onlyDiffuseSamples = hasEmitterLights && !hasGloss && !hasTranslucency && ambientRule != ambientCone &&
                                ambientRule != ambientHorizons && reflectionRule == reflectionOffMetals && throughRule != throughAllLights;

// Irradiance of a sample of an emissive surface.
vec3 sampleIrradiance(Light light, vec3 n) {
  vec3 facing = facingIrradianceOfEmitter(light, vPosition, n);
  if (isLitByCube && facing == vec3(0.0)) return facing;
  return lampShadow(light) * facing;
}

// An area light in a glossy lobe; Fresnel's reflectance is that of its mean direction.
vec3 mirroredShape(Light light, FragmentMaterial m, vec3 n, vec3 toEye, vec3 toLight) {
  float alpha = max(m.roughness * m.roughness, 0.002);
  vec2 first = lobeAlbedo(albedos, max(dot(n, toEye), 0.0), m.roughness).xy;
  vec3 between = toEye + toLight;
  float rise = pow(clamp(1.0 - dot(toEye, between) * inversesqrt(max(dot(between, between), 1e-12)), 0.0, 1.0), 5.0);
  float share = lobeShare(shapeFrom(light, vPosition), n, toEye, alpha) * (first.x + first.y);
  return share * light.intensityRange.rgb * mix(m.f0, vec3(m.grazing), rise);
}

// What bumps leave of a light's irradiance: none from below the surface.
vec3 bumpedIrradianceOn(Light light, Normals n, out vec3 toLight, out float radius) {
  vec3 irradiance = irradianceOn(light, vPosition, n.bumped, toLight, radius);
  if (hasNormalTexture) {
    if (dot(n.geometric, toLight) <= 0.0) irradiance = vec3(0.0);
  }
  return irradiance;
}

// How much of lights' specular reflection a surface shows: of lamps, and of the sky's sun, which metals and glass reflect with
// the rest of the sky.
struct Highlights {
  float ofLamps;
  float ofSun;
};

// Diffuse light of a light that does not come through the transfer; specular reflection of any, but for what the
// transfer reflects. `arriving`: share that comes past what the picture shows.
vec3 shadeLight(Light light, float arriving, FragmentMaterial m, Normals n, vec3 toEye, Highlights highlights, Visibility seen) {
  vec3 sum = vec3(0.0);
  bool transferred = isTransferred(light);
  if (transferred && reflectionRule == reflectionThroughTransfer) return sum;
  vec3 toLight;
  float radius;
  vec3 irradiance = bumpedIrradianceOn(light, n, toLight, radius);
  if (seen.cone.there) arriving *= lampInCone(seen.cone, toLight, radius);
  if (ambientRule == ambientHorizons) {
    if (seen.horizons.there) arriving *= lampAboveHorizon(seen.horizons, light, toLight, radius);
  }
  if (hasNearLamps || (isLitByCube && irradiance != vec3(0.0))) arriving *= lampShadow(light);
  if (!transferred) sum += arriving * irradiance * m.albedo / pi;
  if (!transferred && hasTranslucency && translucency.a > 0.0) {
    vec3 toBack;
    sum += irradianceOn(light, vPosition, -n.bumped, toBack, radius) * m.through / pi;
  }
  float specularWeight = takesSuns && isSun(light) ? highlights.ofSun : highlights.ofLamps;
  if (specularWeight > 0.0) {
    if (hasNormalTexture) irradiance = irradianceOn(light, vPosition, n.reflecting, toLight, radius);
    vec3 mirrored = irradiance * specularBrdf(m, n.reflecting, toEye, toLight);
    if (hasAreaLights) {
      if (isArea(light)) mirrored = mirroredShape(light, m, n.reflecting, toEye, toLight);
    }
    sum += arriving * specularWeight * vHighlight * mirrored;
  }
  return sum;
}

vec3 shadeLights(FragmentMaterial m, Normals n, vec3 toEye, Highlights highlights, Visibility seen) {
  vec3 sum = vec3(0.0);
  vec4 open = findsLight ? texelFetch(screenLamps, ivec2(gl_FragCoord.xy), 0) : vec4(1.0);
  // Lamps whose number is known are read once for all pixels.
  if (lampCount > 0) sum += shadeLight(lights[0], open.x, m, n, toEye, highlights, seen);
  if (lampCount > 1) sum += shadeLight(lights[1], open.y, m, n, toEye, highlights, seen);
  if (lampCount > 2) sum += shadeLight(lights[2], open.z, m, n, toEye, highlights, seen);
  if (lampCount > 3) sum += shadeLight(lights[3], open.w, m, n, toEye, highlights, seen);
  if (lampCount < 0 || !onlyDiffuseSamples) {
    int count = onlyDiffuseSamples ? counts.y : counts.x;
    for (int k = max(lampCount, 0); k < count; ++k) sum += shadeLight(lights[k], k < 4 ? open[k] : 1.0, m, n, toEye, highlights, seen);
  }
  if (!onlyDiffuseSamples) return sum;
  vec3 irradiance = vec3(0.0);
  for (int k = 0; k < sampleCount; ++k)  // which compilers write out, as it is short
    irradiance += sampleIrradiance(lights[lampCount + k], n.bumped);
  for (int k = counts.y; sampleCount < 0 && k < counts.x; ++k) irradiance += sampleIrradiance(lights[k], n.bumped);
  return sum + irradiance * m.albedo / pi;
}

const int correctionNone = 0;
const int correctionByCrease = 1;
const int correctionByCubic = 2;

// Accessibility with the light that surfaces nearby send on, taken to be of the same albedo.
// [1] Akenine-Moller et al., "Real-Time Rendering", 4th edition, 2018, Eq. 11.13.
// [2] Jimenez et al., "Practical real-time strategies for accurate indirect occlusion", 2016: a fit to traced scenes.
vec3 correctedAccessibility(float accessibility, vec3 albedo) {
  if (aoCorrection == correctionByCubic) {
    vec3 cubic = 2.0404 * albedo - 0.3324, square = 0.6417 - 4.7951 * albedo, linear = 2.7552 * albedo + 0.6903;
    vec3 fitted = ((cubic * accessibility + square) * accessibility + linear) * accessibility;
    return clamp(fitted, vec3(accessibility), vec3(1.0));  // [2] clamps below
  }
  if (aoCorrection != correctionByCrease) return vec3(accessibility);
  return vec3(accessibility) / max(vec3(1.0) - albedo * (1.0 - accessibility), vec3(1e-6));
}

// Baked irradiance of a side where a normal map turns its unit normal n to m.
vec3 bumpedIrradiance(bool front, vec3 n, vec3 m) {
  int triangle = triangleHere();
  if (ambientRule == ambientEncodedMap) return encodedMapIrradiance(triangle, front, vPosition, n, m);
  if (!hasNormalTexture) return lightMapIrradiance(triangle, front, vPosition);
  return mappedLightMapIrradiance(triangle, front, vPosition, n, m);
}

// Whether light comes through the surface, of which transfer knows what arrives on either side.
bool passesKnownLight() { return hasTranslucency && translucency.a > 0.0 && knowsThrough != 0; }

// How much of the sky a surface sees, and around which direction; a vector of no length: its own normal.
struct Openness {
  float accessibility;
  vec3 direction;
  vec3 irradiance;  // over pi; where light was found
};

Openness opennessHere() {
  if (findsLight) {
    vec4 sky = texelFetch(screenInput, ivec2(gl_FragCoord.xy), 0);
    return Openness(sky.w, vec3(0.0), sky.rgb);
  }
  if (ambientRule == ambientScreen) {
    vec4 seen = texelFetch(screenInput, ivec2(gl_FragCoord.xy), 0);
    return Openness(seen.w, seen.xyz, vec3(0.0));
  }
  float accessibility = ambientRule == ambientAccessible && passesKnownLight() && !gl_FrontFacing ? vReflected.x : vAccessibility;
  return Openness(accessibility, ambientRule == ambientAccessible && gl_FrontFacing ? vBentNormal.xyz : vec3(0.0), vec3(0.0));
}

// How open the surface's other side is; where that is not known: as open as this one.
float opennessBeyond(Openness open) {
  if (ambientRule != ambientAccessible || !passesKnownLight()) return open.accessibility;
  return gl_FrontFacing ? vReflected.x : vAccessibility;
}

// What screen-space occlusion found arrives; n: without bumps, which turn the sky's light alone.
vec3 shadeFoundLight(FragmentMaterial m, vec3 n, vec3 bumped, Openness open) {
  vec3 arriving = open.irradiance;
  if (hasNormalTexture) arriving *= ambientAround(bumped) / max(ambientAround(n), vec3(1e-6));
  if (aoCorrection != correctionNone)
    arriving *= correctedAccessibility(open.accessibility, m.albedo) / max(open.accessibility, 1e-6);
  vec3 direct = open.irradiance;
  if (hasNormalTexture) direct *= ambientAround(bumped) / max(ambientAround(n), vec3(1e-6));
  if (findsBounce) arriving += texelFetch(screenBounce, ivec2(gl_FragCoord.xy), 0).rgb;
  vec3 radiance = m.albedo * partsShown(arriving, direct);
  if (hasTranslucency && translucency.a > 0.0)
    radiance += partShown(partDirect, m.through * open.accessibility * ambientAround(-bumped));
  return radiance;
}

// The sky that vertices have above their horizons; n: without bumps, which turn it as they turn all of the sky.
vec3 shadeSkyAboveHorizons(FragmentMaterial m, vec3 n, vec3 bumped, Openness open) {
  vec3 arriving = vTransferred;
  if (hasNormalTexture) arriving *= ambientAround(bumped) / max(ambientAround(n), vec3(1e-6));
  vec3 radiance = m.albedo * arriving;
  if (hasTranslucency && translucency.a > 0.0) radiance += m.through * open.accessibility * ambientAround(-bumped);
  return partShown(partDirect, radiance);
}

const int filterCone = 0;

// The sky above a surface over its accessible share; n: with bumps, for where no direction is known. [1] 11.3.7: the
// filter's middle is the bent normal, and its size depends on the accessibility.
vec3 accessibleSky(Openness open, OpenCone cone, vec3 n) {
  if (cone.there) return skyInCone(cone);
  if (dot(open.direction, open.direction) <= 1e-12) return ambientAround(n);
  vec3 axis = normalize(open.direction);
  return aoFilter == filterCone ? skyInCone(coneOfAccessibility(axis, open.accessibility)) : ambientAround(axis);
}

// The parts of it that are shown; n: without bumps.
vec3 shadeAmbient(FragmentMaterial m, vec3 n, vec3 bumped, Openness open, OpenCone cone) {
  if (ambientRule == ambientLightMap || ambientRule == ambientEncodedMap || ambientRule == ambientEncodedVertices) {
    float side = gl_FrontFacing ? 1.0 : -1.0;
    vec3 mapped = mappedNormal(side * n, vPosition, triangleHere(), vTexCoords);
    // Vertices have light of their fronts only; backs show the same.
    if (ambientRule == ambientEncodedVertices) {
      return partShown(partBaked, m.albedo / pi * encodedVertexIrradiance(triangleHere(), vPosition, side * n, mapped));
    }
    mapped *= side;
    vec3 radiance = m.albedo / pi * bumpedIrradiance(gl_FrontFacing, n, mapped);
    if (hasTranslucency && translucency.a > 0.0) radiance += m.through / pi * bumpedIrradiance(!gl_FrontFacing, -n, -mapped);
    return partShown(partBaked, radiance);
  }
  if (isLitByCube) {
    vec3 radiance = m.albedo * (vTransferred + vOpenness * objectIrradiance(bumped));
    if (hasTranslucency && translucency.a > 0.0) radiance += m.through * vOpenness * objectIrradiance(-bumped);
    return partShown(partBaked, radiance);
  }
  if (ambientRule == ambientTransferred) {
    if (hasCharts) {
      if (vChartCoord.w > 0.5) return partShown(partBaked, m.albedo * texture(lightMaps, vChartCoord.xyz).rgb);
    }
    if (!passesKnownLight()) return partShown(partBaked, m.albedo * vTransferred);
    return partShown(partBaked, gl_FrontFacing ? m.albedo * vTransferred + m.through * vReflected
                                               : m.albedo * vReflected + m.through * vTransferred);
  }
  if (findsLight) return shadeFoundLight(m, n, bumped, open);
  if (ambientRule == ambientHorizons && gl_FrontFacing) return shadeSkyAboveHorizons(m, n, bumped, open);
  vec3 around = dot(open.direction, open.direction) > 1e-12 ? normalize(open.direction) : bumped;
  vec3 share = partsShown(correctedAccessibility(open.accessibility, m.albedo), vec3(open.accessibility));
  vec3 radiance = m.albedo * share * accessibleSky(open, cone, bumped);
  if (hasTranslucency && translucency.a > 0.0)
    radiance += partShown(partDirect, m.through * opennessBeyond(open) * ambientAround(-around));
  return radiance;
}

void main() {
  FragmentMaterial m = readMaterial(vTexCoords, vColor);
  if (hasCutouts && m.alpha < surfaceFactors.w) discard;
  float alpha = hasBlending && alphaBlend != 0 ? clamp(m.alpha, 0.0, 1.0) : 1.0;
  if (hasUnlit && unlit != 0) {
    showSurface(isSender ? vec3(0.0) : partShown(partEmitted, m.base * alpha), distance(eye.xyz, vPosition), vec3(1.0 - alpha));
    return;
  }
  vec3 even = shadingNormal(vNormal);
  vec3 toEye = eye.w > 0.5 ? normalize(eye.xyz - vPosition) : -forward.xyz;
  int triangle = triangleHere();
  vec3 geometric = (gl_FrontFacing ? 1.0 : -1.0) * FETCH(triangleNormals, triangle).xyz;
  vec3 bumped = bumpedNormal(even, vPosition, triangle, vTexCoords);
  vec3 n = reflectingNormal(bumped, geometric, toEye);
  float nv = max(dot(n, toEye), 0.0);
  // Through diffuse transfer, exit radiance is the albedo times the transferred light and nothing else where a surface
  // is diffuse.
  float layer = hasGloss ? mirrorShare(m.dielectric) * (1.0 - m.metallic) : 0.0;
  float glossy = hasGloss && !isSender ? max(max(m.metallic, m.transmission), layer) : 0.0;
  if (!hasMeasured || measured < 0) m.albedo *= 1.0 - layer * max(m.dielectric.r, max(m.dielectric.g, m.dielectric.b));
  float specularWeight = reflectionRule == reflectionOffMetals || isSender ? glossy : 1.0;
  Highlights highlights = Highlights(specularWeight, specularWeight - glossy);

  Visibility seen = Visibility(openCone(), horizonsHere(even));
  Openness open = opennessHere();
  if (showsParts && shownLayer == partAccessibility) {
    showSurface(vec3(open.accessibility * alpha), distance(eye.xyz, vPosition), vec3(1.0 - alpha));
    return;
  }
  vec3 radiance = isSender ? vec3(0.0) : partShown(partEmitted, m.emission * vGlow);
  radiance += shadeAmbient(m, even, bumped, open, seen.cone) + partShown(partDirect, shadeLights(m, Normals(geometric, bumped, n), toEye, highlights, seen));
  if (throughRule == throughAllLights) radiance += partShown(partReflected, vReflected);
  if (hasCaustics) {
    if (causticCorner.w != 0)
      radiance += partShown(partCaustic, m.albedo / pi * texelFetch(caustics, ivec2(gl_FragCoord.xy) / causticCorner.w + causticCorner.xy, 0).rgb);
  }
  vec3 reflectance = hasGloss ? skyReflectance(m, nv) * glossy : vec3(0.0);
  if (reflectionRule == reflectionThroughTransfer) {
    radiance += partShown(partReflected, reflectThroughTransfer(m, triangle, vPosition, n, toEye));
  } else if (hasGloss) {
    vec3 reflected = reflect(-toEye, n);
    float share = open.accessibility;
    if (seen.cone.there) share = lobeInCone(seen.cone, m.roughness, reflected);
    if (ambientRule == ambientHorizons) {
      if (seen.horizons.there) share = lobeAboveHorizon(seen.horizons, m.roughness, reflected);
    }
    vec3 around = isLitByCube ? surroundingRadiance(vPosition, reflected, m.roughness)
                              : share * skyRadiance(reflected, levelOfRoughness(m.roughness));
    radiance += partShown(partReflected, reflectance * around);
  }

  vec3 through = m.transmission * m.base * (vec3(1.0) - clamp(reflectance, 0.0, 1.0));
  showSurface(radiance * alpha, distance(eye.xyz, vPosition), vec3(1.0 - alpha) + alpha * through);
}
