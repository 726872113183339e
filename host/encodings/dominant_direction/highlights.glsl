// Lamps in the dominant directions; the rest is an even sky over the surface and one below it.
const int encodedLampCount = encodedLamps;

vec3 encodedLamp(float v[encodedValueCount], mat3 frame, int i, out vec3 toLamp) {
  int lamp = 3 * encodedLamps + 6 + 3 * i;
  toLamp = encodedDirection(v[3 * i], v[3 * i + 1], v[3 * i + 2], frame[2]);
  return max(vec3(v[lamp], v[lamp + 1], v[lamp + 2]), vec3(0.0));
}

vec3 encodedRadiance(float v[encodedValueCount], mat3 frame, vec3 axis, float spread) {
  const int first = 3 * encodedLamps;
  vec3 above = vec3(v[first], v[first + 1], v[first + 2]), below = vec3(v[first + 3], v[first + 4], v[first + 5]);
  return max(mix(below, above, shareOver(frame[2], axis, spread)), vec3(0.0)) / encodedPi;
}
