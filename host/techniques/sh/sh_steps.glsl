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

// Bands of the transfer of an open receiver, the clamped cosine over pi, one after the other.
struct OpenSteps {
  float legendre;
  float before;
  float even;  // clampedCosine(l) of even bands
};

OpenSteps beginOpen() { return OpenSteps(1.0, 0.0, 1.0); }

// Returns 4 pi times band l in a direction at a cosine to the normal, and steps to l + 1.
float bandOfOpen(inout OpenSteps s, int l, float cosine) {
  float zonal = l == 1 ? 0.666666667 : l % 2 == 0 ? s.even : 0.0;
  float band = zonal * float(2 * l + 1) * s.legendre;
  if (l % 2 == 0) s.even *= float(1 - l) / float(l + 4);
  float next = (float(2 * l + 1) * cosine * s.legendre - float(l) * s.before) / float(l + 1);
  s.before = s.legendre;
  s.legendre = next;
  return band;
}

// Returns that transfer in a direction, cut to the bands of an order: sh::openTowards() of host/basis/sh_zonal.h.
float openTowards(float cosine, int order) {
  OpenSteps s = beginOpen();
  float sum = 0.0;
  for (int l = 0; l < order; ++l) sum += bandOfOpen(s, l, cosine);
  return 0.0795774715 * sum;  // 1 / (4 pi)
}
