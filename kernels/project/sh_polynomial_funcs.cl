// Spherical harmonics as polynomials of a unit direction: orthonormal, no Condon-Shortley phase, index l(l+1)+m, as
// project/sh_funcs.cl computes them for any order from a table.
#ifndef PRELIGHT_PROJECT_SH_POLYNOMIAL_FUNCS_CL
#define PRELIGHT_PROJECT_SH_POLYNOMIAL_FUNCS_CL

// Writes scale x the functions of band 2 to values [5].
void shOfBand2(float3 w, float scale, float* values) {
  const float mixed = 1.0925484306f * scale;  // sqrt(15 / (4 pi))
  values[0] = mixed * w.x * w.y;
  values[1] = mixed * w.y * w.z;
  values[2] = 0.3153915653f * scale * (3.0f * w.z * w.z - 1.0f);  // sqrt(5 / (16 pi))
  values[3] = mixed * w.x * w.z;
  values[4] = 0.5f * mixed * (w.x * w.x - w.y * w.y);
}

// Writes scale x the functions of band 3 to values [7].
void shOfBand3(float3 w, float scale, float* values) {
  const float xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  const float outer = 0.5900435899f * scale;                        // sqrt(35 / (32 pi))
  const float inner = 0.4570457995f * scale * (5.0f * zz - 1.0f);   // sqrt(21 / (32 pi))
  const float mixed = 2.8906114426f * scale * w.z;                  // sqrt(105 / (4 pi))
  values[0] = outer * w.y * (3.0f * xx - yy);
  values[1] = mixed * w.x * w.y;
  values[2] = inner * w.y;
  values[3] = 0.3731763326f * scale * w.z * (5.0f * zz - 3.0f);  // sqrt(7 / (16 pi))
  values[4] = inner * w.x;
  values[5] = 0.5f * mixed * (xx - yy);
  values[6] = outer * w.x * (xx - 3.0f * yy);
}

// Writes scale x the functions of band 4 to values [9].
void shOfBand4(float3 w, float scale, float* values) {
  const float xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z, xy = w.x * w.y;
  const float outer = 2.5033429418f * scale;                             // 3 sqrt(35 / (16 pi))
  const float third = 1.7701307698f * scale * w.z;                       // 3 sqrt(35 / (32 pi))
  const float second = 0.9461746958f * scale * (7.0f * zz - 1.0f);       // 3 sqrt(5 / (16 pi))
  const float first = 0.6690465436f * scale * w.z * (7.0f * zz - 3.0f);  // 3 sqrt(5 / (32 pi))
  values[0] = outer * xy * (xx - yy);
  values[1] = third * w.y * (3.0f * xx - yy);
  values[2] = second * xy;
  values[3] = first * w.y;
  values[4] = 0.1057855469f * scale * (35.0f * zz * zz - 30.0f * zz + 3.0f);  // 3 / (16 sqrt(pi))
  values[5] = first * w.x;
  values[6] = 0.5f * second * (xx - yy);
  values[7] = third * w.x * (xx - 3.0f * yy);
  values[8] = 0.25f * outer * (xx * xx - 6.0f * xx * yy + yy * yy);
}

// Writes scale x the functions of bands 2 to order - 1 to values; order is 3 to 5.
void higherSh(float3 w, float scale, int order, float* values) {
  shOfBand2(w, scale, values);
  if (order > 3) shOfBand3(w, scale, values + 5);
  if (order > 4) shOfBand4(w, scale, values + 12);
}

#endif
