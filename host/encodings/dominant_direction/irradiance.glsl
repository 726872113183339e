// [directions, residual above, residual below, lamps][3]; encodedLamps is 1 to 3.
const int encodedValueCount = 6 * encodedLamps + 6;

vec3 encodedDirection(float x, float y, float z, vec3 normal) {
  float largest = max(abs(x), max(abs(y), abs(z)));
  return largest > 0.0 ? normalize(vec3(x, y, z) / largest) : normal;
}

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 normal) {
  const int first = 3 * encodedLamps;
  float up = dot(normal, frame[2]);
  vec3 sum = (0.5 + 0.5 * up) * vec3(v[first], v[first + 1], v[first + 2]) +
             (0.5 - 0.5 * up) * vec3(v[first + 3], v[first + 4], v[first + 5]);
  for (int i = 0; i < encodedLamps; ++i) {
    int lamp = first + 6 + 3 * i;
    float cosine = max(dot(normal, encodedDirection(v[3 * i], v[3 * i + 1], v[3 * i + 2], frame[2])), 0.0);
    sum += cosine * vec3(v[lamp], v[lamp + 1], v[lamp + 2]);
  }
  return max(sum, vec3(0.0));
}
