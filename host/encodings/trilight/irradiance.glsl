// [direction, colour along it, across it, against it][3].
const int encodedValueCount = 12;

vec3 encodedDirection(float x, float y, float z, vec3 normal) {
  float largest = max(abs(x), max(abs(y), abs(z)));
  return largest > 0.0 ? normalize(vec3(x, y, z) / largest) : normal;
}

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 normal) {
  float cosine = clamp(dot(normal, encodedDirection(v[0], v[1], v[2], frame[2])), -1.0, 1.0);
  return max(max(cosine, 0.0) * vec3(v[3], v[4], v[5]) + (1.0 - abs(cosine)) * vec3(v[6], v[7], v[8]) +
                 max(-cosine, 0.0) * vec3(v[9], v[10], v[11]),
             vec3(0.0));
}
