// Lamps with shadow maps (viewer/shadows/shadow_map_pass.h); needs lights.glsl.
#include "shadows.glsl"

const int mostMaps = 256;  // as viewer/lights/light_block.cpp has it

// Returns the share of a lamp's light that reaches a point of a surface: the mean over the maps of its parts. `normal`: of its triangle,
// on the side that is seen.
float lampThroughMaps(Light light, vec3 point, vec3 normal) {
  int code = int(-light.cone.z + 0.5) - 1;
  int first = code % mostMaps, count = code / mostMaps + 1;
  bool isSample = hasEmitterLights && kindOf(light) == kindEmitter;
  if (count == 1) return visibility(first, point, normal, isSample ? 0 : 1);
  float sum = 0.0;
  for (int part = first; part < first + count; ++part) sum += visibility(part, point, normal, 0);
  return sum / float(count);
}
