// The reflected light of encodings that tell irradiance alone: about any axis the mean that a cosine lobe meets.
const int encodedLampCount = 0;

vec3 encodedLamp(float v[encodedValueCount], mat3 frame, int i, out vec3 toLamp) {
  toLamp = frame[2];
  return vec3(0.0);
}

vec3 encodedRadiance(float v[encodedValueCount], mat3 frame, vec3 axis, float spread) {
  return encodedIrradiance(v, frame, axis) / encodedPi;
}
