// Real spherical harmonics up to order 8 as host/basis/sh.cpp has them: the same recurrences in float.
const int maxCoefficients = 64;

void evaluateSh(vec3 w, int order, out float values[maxCoefficients]) {
  float real = 1.0;
  float imaginary = 0.0;
  float sectoral = 0.282094792;  // sqrt(1 / (4 pi))
  for (int m = 0; m < order; ++m) {
    if (m > 0) {
      float next = real * w.x - imaginary * w.y;
      imaginary = imaginary * w.x + real * w.y;
      real = next;
      sectoral *= sqrt(float(2 * m + 1) / float(2 * m));
    }
    float before = 0.0;
    float p = m > 0 ? 1.41421356 * sectoral : sectoral;
    for (int l = m; l < order; ++l) {
      if (l > m) {
        float a = sqrt(float(4 * l * l - 1) / float(l * l - m * m));
        float b = l > 1 ? sqrt(float((l - 1) * (l - 1) - m * m) / float(4 * (l - 1) * (l - 1) - 1)) : 0.0;
        float next = a * (w.z * p - b * before);
        before = p;
        p = next;
      }
      values[l * (l + 1) + m] = p * real;
      if (m > 0) values[l * (l + 1) - m] = p * imaginary;
    }
  }
}
