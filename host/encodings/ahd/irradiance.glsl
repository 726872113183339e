// [direction, ambient, highlight][3].
const int encodedValueCount = 9;

vec3 encodedDirection(float x, float y, float z, vec3 normal) {
  float largest = max(abs(x), max(abs(y), abs(z)));
  return largest > 0.0 ? normalize(vec3(x, y, z) / largest) : normal;
}

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 normal) {
  float cosine = max(dot(normal, encodedDirection(v[0], v[1], v[2], frame[2])), 0.0);
  return max(vec3(v[3], v[4], v[5]) + cosine * vec3(v[6], v[7], v[8]), vec3(0.0));
}
