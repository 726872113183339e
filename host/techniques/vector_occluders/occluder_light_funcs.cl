// Light that arrives at a place, in OpenCL C and in GLSL; viewer/lights/lighting.h documents the formulas.
#ifndef PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_LIGHT_FUNCS_CL
#define PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_LIGHT_FUNCS_CL

#include "techniques/vector_occluders/occluder_wave_funcs.cl"

#define FAR_DISTANCE 1e18f

// A light as it is packed in four texels; OccluderLight documents the values.
STRUCT_NAME(SceneLight)
struct SceneLight {
  vec4 positionKind;
  vec4 directionExtent;
  vec4 intensityRange;
  vec4 cone;     // scale, offset, highlight, two-sided
  vec3 flicker;  // factor of the intensity
};

// The light that arrives at a place, without occlusion.
STRUCT_NAME(ArrivingLight)
struct ArrivingLight {
  vec3 irradiance;  // on a surface that faces the light
  vec3 toLight;     // unit, or zero at the light's position
  float distance;   // m; negative when infinite
};

SceneLight readLight(TEXELS lights, TEXELS waves, int light, OccluderTerms terms) {
  SceneLight result;
  result.positionKind = FETCH(lights, 4 * light);
  result.directionExtent = FETCH(lights, 4 * light + 1);
  result.intensityRange = FETCH(lights, 4 * light + 2);
  result.cone = FETCH(lights, 4 * light + 3);
  result.flicker = VEC3(1.0f);
  if (terms.fire > 0.0f) result.flicker = flickerOf(waves, light, terms);
  return result;
}

ArrivingLight arrivingAt(SceneLight light, vec3 place) {
  int kind = TO_INT(light.positionKind.w + 0.5f);
  vec3 intensity = light.intensityRange.xyz * light.flicker;
  ArrivingLight result;
  if (kind == PRELIGHT_LIGHT_DIRECTIONAL) {
    result.irradiance = intensity;
    result.toLight = -light.directionExtent.xyz;
    result.distance = -1.0f;
    return result;
  }
  vec3 path = light.positionKind.xyz - place;
  float square = min(dot(path, path), FAR_DISTANCE * FAR_DISTANCE);
  result.toLight = unitOf(path);
  result.distance = sqrt(square);
  float cosine = -dot(light.directionExtent.xyz, result.toLight);
  float falloff = 0.0f;
  if (kind == PRELIGHT_LIGHT_EMITTER) {
    float area = light.directionExtent.w;
    float lobe = light.cone.w > 0.5f ? ABS(cosine) : max(cosine, 0.0f);
    falloff = lobe * area / (square + area / OCCLUDER_PI);
  } else {
    falloff = 1.0f / max(square, light.directionExtent.w);
    if (light.intensityRange.w > 0.0f) {
      float ratio = min(square / (light.intensityRange.w * light.intensityRange.w), 2.0f);
      falloff *= clamp(1.0f - ratio * ratio, 0.0f, 1.0f);
    }
    if (kind == PRELIGHT_LIGHT_SPOT) {
      float angular = clamp(cosine * light.cone.x + light.cone.y, 0.0f, 1.0f);
      falloff *= angular * angular;
    }
  }
  result.irradiance = intensity * falloff;
  return result;
}

#endif
