// An even sky S (1 + n.N) / 2 and lamps P.n have the same linear functions as the basis: those of degree 2 are left out.
vec3 encodedSky(float v[encodedValueCount], mat3 frame, out mat3 vectors) {
  vec3 sky;
  for (int c = 0; c < 3; ++c) {
    sky[c] = max(2.0 * (0.398942280 * v[c] - 0.690988299 * v[6 + c]), 0.0);
    vec3 linear = 0.690988299 * vec3(v[9 + c], v[3 + c], 2.0 * v[6 + c]);
    vectors[c] = frame * (linear - vec3(0.0, 0.0, 0.5 * sky[c]));
  }
  return sky;
}
#include "sky_and_lamp.glsl"
