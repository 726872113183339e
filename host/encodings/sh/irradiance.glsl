// Spherical harmonics of radiance, [coefficient][channel]; encodedOrder is 2 or 3.
const int encodedValueCount = 3 * encodedOrder * encodedOrder;

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 n) {
  float basis[9];  // times the clamped cosine's bands: pi, 2 pi / 3, pi / 4
  basis[0] = 0.886226925;
  basis[1] = 1.023326708 * n.y;
  basis[2] = 1.023326708 * n.z;
  basis[3] = 1.023326708 * n.x;
  basis[4] = 0.858085531 * n.x * n.y;
  basis[5] = 0.858085531 * n.y * n.z;
  basis[6] = 0.247707956 * (3.0 * n.z * n.z - 1.0);
  basis[7] = 0.858085531 * n.x * n.z;
  basis[8] = 0.429042765 * (n.x * n.x - n.y * n.y);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < encodedOrder * encodedOrder; ++i)
    sum += basis[i] * vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
  return max(sum, vec3(0.0));
}
