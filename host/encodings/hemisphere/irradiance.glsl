// Irradiance along the surface's normal and against it, [direction][channel].
const int encodedValueCount = 6;

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 normal) {
  float cosine = dot(normal, frame[2]);
  vec3 above = vec3(v[0], v[1], v[2]);
  vec3 below = vec3(v[3], v[4], v[5]);
  return max((0.5 + 0.5 * cosine) * above + (0.5 - 0.5 * cosine) * below, vec3(0.0));
}
