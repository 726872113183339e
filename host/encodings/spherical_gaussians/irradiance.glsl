// Radiance of Gaussian lobes, [lobe][channel]. The irradiance of a lobe is a polynomial in the cosine to its direction.
const int encodedValueCount = 3 * encodedLobes;

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 normal) {
  vec3 n = normal * frame;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < encodedLobes; ++i) {
    float x = dot(n, encodedDirections[i]);
    float s = x * x;
    float lobe = encodedPowers[0] + encodedPowers[1] * x +
                 s * (encodedPowers[2] + s * (encodedPowers[3] + s * (encodedPowers[4] + s * encodedPowers[5])));
    sum += lobe * vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
  }
  return max(sum, vec3(0.0));
}
