// The even sky and the lamps of SH of order 2, the first of the numbers (docs/notes/lightmaps.md, "Normal maps"). Returns the
// sky's irradiance; vectors: [channel], the direction of a channel's lamp times its perpendicular irradiance.
vec3 encodedSky(float v[encodedValueCount], mat3 frame, out mat3 vectors) {
  const float constant = 0.282094792;  // sqrt(1 / 4pi)
  const float linear = 0.488602512;    // sqrt(3 / 4pi)
  vec3 sky;
  for (int c = 0; c < 3; ++c) {
    vec3 vector = vec3(v[9 + c], v[3 + c], v[6 + c]) / linear;
    float own = dot(vector, frame[2]);
    float size = length(vector);
    float all = max(v[c] / constant, size);
    float b = 2.0 * all - own;
    float root = b * b - 3.0 * (all - size) * (all + size);
    sky[c] = clamp((b - sqrt(max(root, 0.0))) / 3.0, 0.0, max(own, 0.0));
    vectors[c] = vector - sky[c] * frame[2];
  }
  return sky;
}
