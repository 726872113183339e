// Spherical harmonics of order 2, [coefficient][channel], as an even sky of irradiance `sky` and a lamp of the rest.
const int encodedValueCount = 12;

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 normal) {
  const float constant = 0.282094792;  // sqrt(1 / 4pi)
  const float linear = 0.488602512;    // sqrt(3 / 4pi)
  vec3 n = frame[2];
  float cosine = dot(normal, n);
  vec3 result;
  for (int c = 0; c < 3; ++c) {
    vec3 vector = vec3(v[9 + c], v[3 + c], v[6 + c]) / linear;
    float own = dot(vector, n);
    float size = sqrt(dot(vector, vector));
    float all = max(v[c] / constant, size);
    float b = 2.0 * all - own;
    float root = b * b - 3.0 * (all - size) * (all + size);
    float sky = clamp((b - sqrt(max(root, 0.0))) / 3.0, 0.0, max(own, 0.0));
    result[c] = max(0.5 * sky * (1.0 + cosine), 0.0) + max(dot(vector - sky * n, normal), 0.0);
  }
  return result;
}
