// The directional part is a lamp, the ambient part light from everywhere (Lazarov, "Getting more physical in Call of Duty: Black
// Ops II", 2013).
const int encodedLampCount = 1;

vec3 encodedLamp(float v[encodedValueCount], mat3 frame, int i, out vec3 toLamp) {
  toLamp = encodedDirection(v[0], v[1], v[2], frame[2]);
  return max(vec3(v[6], v[7], v[8]), vec3(0.0));
}

vec3 encodedRadiance(float v[encodedValueCount], mat3 frame, vec3 axis, float spread) {
  return max(vec3(v[3], v[4], v[5]), vec3(0.0)) / encodedPi;
}
