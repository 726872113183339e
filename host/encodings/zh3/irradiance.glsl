// Spherical harmonics of order 2, [coefficient][channel], and the coefficients [channel] of the quadratic zonal harmonic
// about the axis of the linear band's luminance; encodedHallucination leaves these out.
const int encodedValueCount = encodedHallucination ? 12 : 15;

vec3 encodedTerm(float v[encodedValueCount], int i) { return vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]); }

vec3 encodedAxis(float v[encodedValueCount], vec3 normal) {
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  vec3 linear = vec3(dot(encodedTerm(v, 3), luminance), dot(encodedTerm(v, 1), luminance),
                     dot(encodedTerm(v, 2), luminance));
  float largest = max(abs(linear.x), max(abs(linear.y), abs(linear.z)));
  return largest > 0.0 ? normalize(linear / largest) : normal;
}

// The zonal term along the axis: stored, or guessed from the constant band and the linear one's part along it.
vec3 encodedZonal(float v[encodedValueCount], vec3 axis) {
  if (!encodedHallucination) return encodedTerm(v, encodedValueCount / 3 - 1);
  vec3 all = encodedTerm(v, 0);
  vec3 along = abs(axis.y * encodedTerm(v, 1) + axis.z * encodedTerm(v, 2) + axis.x * encodedTerm(v, 3));
  vec3 found = vec3(0.0);
  for (int c = 0; c < 3; ++c)
    if (all[c] > 0.0) found[c] = along[c] * (0.08 + 0.6 * (along[c] / all[c]));
  return found;
}

vec3 encodedIrradiance(float v[encodedValueCount], mat3 frame, vec3 n) {
  vec3 axis = encodedAxis(v, frame[2]);
  float cosine = dot(axis, n);
  vec3 linear = 0.886226925 * encodedTerm(v, 0) +
                1.023326708 * (n.y * encodedTerm(v, 1) + n.z * encodedTerm(v, 2) + n.x * encodedTerm(v, 3));
  return max(linear + 0.247707956 * (3.0 * cosine * cosine - 1.0) * encodedZonal(v, axis), vec3(0.0));
}
