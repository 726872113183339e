// The product of the surface's lobe with each Gaussian (Wang et al. 2009, as in Pettineo, "SG series", 2016).
const int encodedLampCount = 0;

vec3 encodedLamp(float v[encodedValueCount], mat3 frame, int i, out vec3 toLamp) {
  toLamp = frame[2];
  return vec3(0.0);
}

vec3 encodedRadiance(float v[encodedValueCount], mat3 frame, vec3 axis, float spread) {
  vec3 a = axis * frame;
  float sharpness = lobeSharpness(spread);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < encodedLobes; ++i)
    sum += meanOfGaussian(a, sharpness, encodedDirections[i], encodedSharpness) * vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
  return max(sum, vec3(0.0));
}
