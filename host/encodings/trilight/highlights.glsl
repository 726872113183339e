// What the colour along the direction has over that across it is a lamp.
const int encodedLampCount = 1;

vec3 encodedLamp(float v[encodedValueCount], mat3 frame, int i, out vec3 toLamp) {
  toLamp = encodedDirection(v[0], v[1], v[2], frame[2]);
  return max(vec3(v[3], v[4], v[5]) - vec3(v[6], v[7], v[8]), vec3(0.0));
}

vec3 encodedRadiance(float v[encodedValueCount], mat3 frame, vec3 axis, float spread) {
  vec3 toLamp;
  vec3 lamp = encodedLamp(v, frame, 0, toLamp) * max(dot(axis, toLamp), 0.0);
  return max(encodedIrradiance(v, frame, axis) - lamp, vec3(0.0)) / encodedPi;
}
