// Angles at the cost of a few multiplications: atan2 takes as long as fifty of them on some devices (PoCL's).
#ifndef PRELIGHT_CORE_ANGLE_FUNCS_CL
#define PRELIGHT_CORE_ANGLE_FUNCS_CL

// Returns atan2(y, x) up to rounding, and 0 at the origin. Abramowitz and Stegun, 4.4.49: within 2e-8 on [0, 1].
float angleOf(float y, float x) {
  const float ax = fabs(x), ay = fabs(y), most = fmax(ax, ay);
  const float t = most > 0.0f ? fmin(ax, ay) / most : 0.0f, t2 = t * t;
  float series = fma(t2, 0.0028662257f, -0.0161657367f);
  series = fma(t2, series, 0.0429096138f);
  series = fma(t2, series, -0.0752896400f);
  series = fma(t2, series, 0.1065626393f);
  series = fma(t2, series, -0.1420889944f);
  series = fma(t2, series, 0.1999355085f);
  series = fma(t2, series, -0.3333314528f);
  float angle = fma(t * t2, series, t);
  if (ay > ax) angle = M_PI_2_F - angle;
  if (x < 0.0f) angle = M_PI_F - angle;
  return copysign(angle, y);
}

#endif
