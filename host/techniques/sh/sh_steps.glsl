// Values of SH in a direction w by the recurrences of host/basis/sh_evaluate.cpp, an m at a time so that nothing of the size of
// order squared is kept: Y_lm is p times real, Y_l-m p times imaginary.
struct ShSteps {
  float real;
  float imaginary;
  float sectoral;
  float before;
  float p;
};

ShSteps beginSh() { return ShSteps(1.0, 0.0, 0.282094792, 0.0, 0.0); }  // sqrt(1 / (4 pi))

// To m, of which the first l is m.
void stepToSector(inout ShSteps s, int m, vec3 w) {
  if (m > 0) {
    float next = s.real * w.x - s.imaginary * w.y;
    s.imaginary = s.imaginary * w.x + s.real * w.y;
    s.real = next;
    s.sectoral *= sqrt(float(2 * m + 1) / float(2 * m));
  }
  s.before = 0.0;
  s.p = m > 0 ? 1.41421356 * s.sectoral : s.sectoral;
}

// From l - 1 to l, above m.
void stepToBand(inout ShSteps s, int l, int m, vec3 w) {
  float a = sqrt(float(4 * l * l - 1) / float(l * l - m * m));
  float b = l > 1 ? sqrt(float((l - 1) * (l - 1) - m * m) / float(4 * (l - 1) * (l - 1) - 1)) : 0.0;
  float next = a * (w.z * s.p - b * s.before);
  s.before = s.p;
  s.p = next;
}

// Returns what the transfer of an open receiver is in a direction, cut to the bands of an order: the clamped cosine over pi.
// sh::openTowards() of host/basis/sh_zonal.h.
float openTowards(float cosine, int order) {
  float legendre = 1.0;
  float before = 0.0;
  float band = 1.0;   // clampedCosine(l) of even bands
  float sum = 0.0;
  for (int l = 0; l < order; ++l) {
    float zonal = l == 1 ? 0.666666667 : l % 2 == 0 ? band : 0.0;
    sum += zonal * float(2 * l + 1) * legendre;
    if (l % 2 == 0) band *= float(1 - l) / float(l + 4);
    float next = (float(2 * l + 1) * cosine * legendre - float(l) * before) / float(l + 1);
    before = legendre;
    legendre = next;
  }
  return 0.0795774715 * sum;  // 1 / (4 pi)
}
