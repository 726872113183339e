// [direction, residual above, residual below, lamp][3].
const int encodedValueCount = 12;

vec3 encodedDirection(float x, float y, float z, vec3 normal) {
  float largest = max(abs(x), max(abs(y), abs(z)));
  return largest > 0.0 ? normalize(vec3(x, y, z) / largest) : normal;
}

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 normal) {
  float up = dot(normal, frame[2]);
  float lamp = max(dot(normal, encodedDirection(v[0], v[1], v[2], frame[2])), 0.0);
  return max((0.5 + 0.5 * up) * vec3(v[3], v[4], v[5]) + (0.5 - 0.5 * up) * vec3(v[6], v[7], v[8]) +
                 lamp * vec3(v[9], v[10], v[11]),
             vec3(0.0));
}
