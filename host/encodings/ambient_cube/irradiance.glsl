// Irradiance along +x, -x, +y, -y, +z, -z of the world, [direction][channel].
const int encodedValueCount = 18;

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 normal) {
  vec3 sum = vec3(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    int face = 3 * (2 * axis + (normal[axis] < 0.0 ? 1 : 0));
    sum += normal[axis] * normal[axis] * vec3(v[face], v[face + 1], v[face + 2]);
  }
  return max(sum, vec3(0.0));
}
