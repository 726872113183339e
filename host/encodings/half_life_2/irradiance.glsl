// Irradiance along three vectors over the surface, [vector][channel].
const int encodedValueCount = 9;

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 normal) {
  const float a = 0.816496581;  // sqrt(2 / 3)
  const float b = 0.408248290;  // sqrt(1 / 6)
  const float c = 0.707106781;  // sqrt(1 / 2)
  const float z = 0.577350269;  // sqrt(1 / 3)
  vec3 n = normal * frame;
  vec3 weight = max(vec3(a * n.x + z * n.z, -b * n.x + c * n.y + z * n.z, -b * n.x - c * n.y + z * n.z), vec3(0.0));
  weight *= weight;
  weight /= max(weight.x + weight.y + weight.z, 1e-6);
  return max(weight.x * vec3(v[0], v[1], v[2]) + weight.y * vec3(v[3], v[4], v[5]) +
                 weight.z * vec3(v[6], v[7], v[8]),
             vec3(0.0));
}
