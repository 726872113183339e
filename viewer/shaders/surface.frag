#version 410 core
// A surface in a shading that draws no shadow maps and no environment maps: what arrives there, from the sky and from lamps, its
// technique answers (ambient.glsl). Where that knows too little, so that nothing looks dead or wrong:
// - lobes reflect lights without shadows, but for vector occluders, whose vertices know what share of the lights' reflection
//   shadows leave, and the sky as far as the technique knows that it is open;
// - what hides the sky is reflected as the mean of the light that arrives from there, where the technique knows that, and as it is
//   where a cube map shows what lies around (around.glsl);
// - through diffuse transfer, the layer of a plain dielectric reflects lamps only as part of the mean light around;
// - glass shows straight through what the picture has behind it, but where the sky is known to lie there;
// - light comes through translucent surfaces where that of their other side is known: of lights without shadows, of a
//   light map, of the sky, and of transfer that was baked with that of other sides;
// - lights that a transfer cannot see rightly (viewer/lights/lighting.h) shine without shadows, but for lamps that have those of
//   shells of distance.
#include "frame.glsl"
#include "variant.glsl"
#include "parts.glsl"
#include "lights.glsl"
#include "material.glsl"
#include "triangles.glsl"
#include "normal_map.glsl"
#include "shading_normal.glsl"
#include "anisotropy.glsl"

const bool layerCovers = hasLayer;
const bool bouncesLater = hasGloss || hasLayer;
#include "scattering.glsl"
#include "top_layers.glsl"
#include "glass_lobe.glsl"
#include "sky.glsl"
#include "around.glsl"
#include "glossy.glsl"
#include "lamp_maps.glsl"

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
uniform float thickness;      // of a body of glass, m

#include "ambient.glsl"
#include "place.glsl"
#include "lobe_axis.glsl"
#include "lamp_lobes.glsl"
#include "sky_lobes.glsl"
#include "surface_output.glsl"

bool isTransferred(Light light) {
  return throughRule == throughAllLights || (throughRule == throughFarLights && isFar(light));
}

// Surfaces that do not show reflections of emissive surfaces sum their samples with fewer operations.
const bool onlyDiffuseSamples = hasEmitterLights && !hasGloss && !hasTranslucency && !shadowsSamples &&
                                reflectionRule == reflectionOffMetals && throughRule != throughAllLights;

// Irradiance of a sample of an emissive surface.
vec3 sampleIrradiance(Light light, Normals n) {
  vec3 facing = facingIrradianceOfEmitter(light, vPosition, n.bumped);
  if (facing == vec3(0.0)) return facing;
  return facing * (isMapped(light) ? lampThroughMaps(light, vPosition, n.geometric) : lampShadow(light));
}

// Returns a light's irradiance on the bumped surface: none from below the surface.
vec3 bumpedIrradianceOn(Light light, Normals n, out vec3 toLight, out float radius) {
  vec3 irradiance = irradianceOn(light, vPosition, n.bumped, toLight, radius);
  if (hasNormalTexture) {
    if (dot(n.geometric, toLight) <= 0.0) irradiance = vec3(0.0);
  }
  return irradiance;
}

// Returns the share of a light's radiance that coat, sheen and layer let through to the body and back.
float passedToBody(Place p, vec3 toLight) {
  if (!layerCovers && !hasTopLayers) return 1.0;
  vec3 wi = inFrame(p.s, p.n.reflecting, toLight);
  if (!isAnisotropic(p.s)) wi = vec3(0.0, 0.0, abs(dot(p.n.bumped, toLight)));
  return p.left * passedTwice(p.s, p.wo, wi);
}

// Whether lobes of a place show the highlights of lamps.
bool showsLamps(Place p) { return reflectsLamps && (hasGloss || layerReflectsLamps || knowsAround(p)); }

// Returns the shares of the lobes of body and coat that glossy transfer holds.
vec2 heldByTransfer(Place p) {
  vec2 held = shareThroughTransfer(vec2(p.s.roughness, p.top.coatRoughness));
  if (hasMeasured && reflectionRule == reflectionThroughTransfer) {
    if (measured >= 0) held.x = 1.0;
  }
  return held;
}

// Returns the shares of what the lobes of body and coat reflect of a light that highlights show.
vec2 shareOfHighlights(Light light, Place p, bool transferred) {
  vec2 held = heldByTransfer(p);
  if (isOfSky(light)) {  // lobes that reflect the sky reflect its lamps with it, and glossy transfer where lamps are in it
    if (reflectionRule == reflectionThroughTransfer && lampsInLobes != 0) return held;
    return vec2(layerCovers ? 0.0 : (1.0 - held.x) * (1.0 - max(p.metallic, p.s.glass)), 0.0);
  }
  vec2 shown = vec2(1.0);
  if (transferred && lampsInLobes == 0) shown -= held;
  if (hasEmitterLights) {  // lobes that see what lies around see emissive surfaces there
    if (kindOf(light) == kindEmitter) {
      shown *= vec2(1.0) - p.around * (vec2(1.0) - held);
      if (hasShadowMaps && !hasGloss) shown.x *= smoothstep(0.2, 0.4, p.s.roughness);  // a smooth layer would show samples as dots
    }
  }
  return shown;
}

// Diffuse light of a light that does not come through the transfer; specular reflection of any, but for what the
// transfer reflects. k: the light's number.
vec3 shadeLight(int k, Light light, Place p, Visibility seen) {
  vec3 sum = vec3(0.0);
  bool transferred = isTransferred(light);
  vec2 shown = shareOfHighlights(light, p, transferred);
  if (transferred && shown == vec2(0.0)) return sum;
  vec3 toLight;
  float radius;
  vec3 irradiance = bumpedIrradianceOn(light, p.n, toLight, radius);
  bool inLobes = reflectionRule == reflectionThroughTransfer && transferred && lampsInLobes != 0;
  float arriving = 1.0;
  if (inLobes)
    arriving = vHighlight;
  else if (!isMapped(light))
    arriving = lampVisibility(seen, k, light, toLight, radius);
  else if (irradiance != vec3(0.0))
    arriving = dot(p.n.geometric, toLight) > 0.0 ? lampThroughMaps(light, vPosition, p.n.geometric) : 0.0;
  if (!isMapped(light) && (hasNearLamps || irradiance != vec3(0.0))) arriving *= lampShadow(light);
  if (!transferred) sum += arriving * irradiance * p.s.diffuse * passedToBody(p, toLight) / pi;
  if (!transferred && hasTranslucency && translucency.a > 0.0) {
    vec3 toBack;
    vec3 behind = irradianceOn(light, vPosition, -p.n.bumped, toBack, radius);
    if (isMapped(light) && behind != vec3(0.0)) behind *= lampThroughMaps(light, vPosition, -p.n.geometric);
    sum += behind * p.s.transmitted * passedToBody(p, toBack) / pi;
  }
  if (!showsLamps(p)) return sum;
  if (transferred && !inLobes && !isMapped(light)) arriving *= vHighlight;
  if (knowsAround(p)) arriving *= lampAround(light, vPosition);
  return sum + arriving * mirroredLight(light, p, irradiance, toLight, shown.x, shown.y);
}

vec3 shadeLights(Place p, Visibility seen) {
  vec3 sum = vec3(0.0);
  // Lamps whose number is known are read once for all pixels.
  if (lampCount > 0) sum += shadeLight(0, lights[0], p, seen);
  if (lampCount > 1) sum += shadeLight(1, lights[1], p, seen);
  if (lampCount > 2) sum += shadeLight(2, lights[2], p, seen);
  if (lampCount > 3) sum += shadeLight(3, lights[3], p, seen);
  if (lampCount < 0 || !onlyDiffuseSamples) {
    int count = onlyDiffuseSamples ? counts.y : counts.x;
    for (int k = max(lampCount, 0); k < count; ++k) sum += shadeLight(k, lights[k], p, seen);
  }
  if (!onlyDiffuseSamples) return sum;
  vec3 irradiance = vec3(0.0);
  for (int k = 0; k < sampleCount; ++k)  // which compilers write out, as it is short
    irradiance += sampleIrradiance(lights[lampCount + k], p.n);
  for (int k = counts.y; sampleCount < 0 && k < counts.x; ++k) irradiance += sampleIrradiance(lights[k], p.n);
  return sum + irradiance * p.s.diffuse / pi;
}

const float mostBounced = 0.25;  // of a lamp's light, in its shadow

// Returns the mean radiance of surroundings that hide the sky, times the share of it that they hide, without the light of lamps whose
// highlights are shown and of those that the sky's lobes hold. Where less arrives than a lamp sends, the place is in its shadow, and all
// light comes from the surroundings.
vec3 hiddenWithoutLamps(Place p, Visibility seen) {
  vec3 n = p.n.bumped;
  vec3 rest = hiddenHere(n, seen.ofSky);
  if (throughRule == throughNone) return rest;
  vec3 way;
  float radius;
  for (int k = 0; k < counts.x; ++k) {
    if (!isTransferred(lights[k]) || !(showsLamps(p) || isOfSky(lights[k]))) continue;
    vec3 sent = irradianceOn(lights[k], vPosition, n, way, radius) / pi;
    float lit = smoothstep(mostBounced, 1.0, largest(rest) / max(largest(sent), 1e-20));
    rest = max(rest - lit * sent, vec3(0.0));
  }
  return rest;
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
  Normals n = Normals(geometric, bumped, reflectingNormal(bumped, geometric, toEye));
  Place p = placeOf(m, vTexCoords, triangle, even, n, toEye);
  if (hasTranslucency) p.s.transmitted *= passageHere();
  Openness open = opennessHere();
  Visibility seen = visibilityHere(even, open);
  if (hasGloss || hasLayer) p.hidden = hiddenWithoutLamps(p, seen);
  if (showsAccessibility()) {
    showSurface(vec3(open.accessibility * alpha), distance(eye.xyz, vPosition), vec3(1.0 - alpha));
    return;
  }
  vec3 radiance = isSender ? vec3(0.0) : partShown(partEmitted, m.emission * (1.0 - p.coated) * vGlow);
  radiance += ambientRadiance(bodyOf(p), even, bumped, open, seen) + partShown(partDirect, shadeLights(p, seen));
  if (throughRule == throughAllLights) radiance += partShown(partReflected, vReflected);
  if (hasCaustics) {
    if (causticCorner.w != 0)
      radiance += partShown(partCaustic, p.s.diffuse / pi * texelFetch(caustics, ivec2(gl_FragCoord.xy) / causticCorner.w + causticCorner.xy, 0).rgb);
  }
  vec3 behind = vec3(0.0);
  if (!isSender) radiance += partShown(partReflected, reflectedAround(p, seen));
  if (hasGlass && !isSender) radiance += partShown(partReflected, shadeGlass(p, seen, behind));
  showSurface(radiance * alpha, distance(eye.xyz, vPosition), vec3(1.0 - alpha) + alpha * behind);
}
