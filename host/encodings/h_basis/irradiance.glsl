// Irradiance in the H-basis, [function][channel]; encodedFunctions is 4 or 6.
const int encodedValueCount = 3 * encodedFunctions;

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 normal) {
  vec3 d = normal * frame;
  float basis[6];
  basis[0] = 0.398942280;                     // sqrt(1 / 2pi)
  basis[1] = 0.690988299 * d.y;               // sqrt(3 / 2pi)
  basis[2] = 0.690988299 * (2.0 * d.z - 1.0);
  basis[3] = 0.690988299 * d.x;
  basis[4] = 1.545096808 * d.x * d.y;         // sqrt(15 / 2pi)
  basis[5] = 0.772548404 * (d.x * d.x - d.y * d.y);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < encodedFunctions; ++i) sum += basis[i] * vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
  return max(sum, vec3(0.0));
}
