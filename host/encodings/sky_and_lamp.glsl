// The reflected light of encodings that are taken for an even sky over the surface and a lamp a channel. needs
// encodedSky(), irradiance of the sky and, out, the lamps' vectors: [channel], directions times perpendicular irradiance.
const int encodedLampCount = 1;

vec3 encodedLamp(float v[encodedValueCount], mat3 frame, int i, out vec3 toLamp) {
  mat3 vectors;
  encodedSky(v, frame, vectors);
  vec3 sum = vectors * encodedLuminance;
  float largest = max(abs(sum.x), max(abs(sum.y), abs(sum.z)));
  toLamp = largest > 0.0 ? normalize(sum / largest) : frame[2];
  return max(toLamp * vectors, vec3(0.0));
}

vec3 encodedRadiance(float v[encodedValueCount], mat3 frame, vec3 axis, float spread) {
  mat3 vectors;
  return encodedSky(v, frame, vectors) * shareOver(frame[2], axis, spread) / encodedPi;
}
