// Lamps whose intensity varies with direction (EXT_lights_ies): host/scene/light_profile.h packs the profiles. OpenCL C
// and GLSL.
// Texels: (columns, rows), the heights of rows + 1, the turns of columns + 1, then [column][row] the intensities at the
// corners: first turn at first and second height, second turn at first and second height.
#ifndef PRELIGHT_TRANSPORT_PROFILE_FUNCS_CL
#define PRELIGHT_TRANSPORT_PROFILE_FUNCS_CL

#include "core/dialect.h"

// Returns the direction across a lamp's axis at which turns are 0; they run from there to cross(it, pole).
vec3 acrossPole(vec3 pole) {
  vec3 other = ABS(pole.x) < 0.6f ? VEC3(1.0f, 0.0f, 0.0f) : VEC3(0.0f, 1.0f, 0.0f);
  return normalize(other - dot(other, pole) * pole);
}

// Returns the last of `count` intervals that begins at or before an angle.
int profileInterval(TEXELS profiles, int first, int count, float angle) {
  int low = 0;
  int high = count;
  while (high - low > 1) {
    int middle = (low + high) / 2;
    if (FETCH(profiles, first + middle).x <= angle)
      low = middle;
    else
      high = middle;
  }
  return low;
}

// Interpolates between the corners of a cell: u along the turns, v along the heights.
float betweenCorners(vec4 corners, float u, float v) {
  return mix(mix(corners.x, corners.y, v), mix(corners.z, corners.w, v), u);
}

// Returns the intensity in a direction in which light leaves a lamp with axis `pole`, whose turns begin at `start`, by
// the profile at `first`.
float profileIntensity(TEXELS profiles, int first, vec3 pole, float start, vec3 direction) {
  vec4 size = FETCH(profiles, first);
  int columns = TO_INT(size.x);
  int rows = TO_INT(size.y);
  vec3 across = acrossPole(pole);
  float x = dot(direction, across);
  float y = dot(direction, cross(across, pole));
  float height = ATAN2(sqrt(x * x + y * y), dot(direction, pole));
  int heights = first + 1;
  int turns = heights + rows + 1;
  float begin = FETCH(profiles, turns).x;
  float around = (ATAN2(y, x) - start - begin) * 0.159154943f;
  float turn = begin + 6.28318531f * (around - floor(around));
  float end = FETCH(profiles, turns + columns).x;
  if (end - begin < 6.2831f && turn > end) return 0.0f;
  if (height < FETCH(profiles, heights).x || height > FETCH(profiles, heights + rows).x + 1e-6f) return 0.0f;
  int row = profileInterval(profiles, heights, rows, height);
  int column = profileInterval(profiles, turns, columns, turn);
  float low = FETCH(profiles, heights + row).x;
  float left = FETCH(profiles, turns + column).x;
  float v = clamp((height - low) / (FETCH(profiles, heights + row + 1).x - low), 0.0f, 1.0f);
  float u = clamp((turn - left) / (FETCH(profiles, turns + column + 1).x - left), 0.0f, 1.0f);
  return betweenCorners(FETCH(profiles, turns + columns + 1 + column * rows + row), u, v);
}

#endif
