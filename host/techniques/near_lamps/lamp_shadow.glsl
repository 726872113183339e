// The shadows of near lamps by shells of distance; needs lights.glsl.

// Returns the share of a lamp's light that arrives. It is sharpened like sharpened() of
// host/techniques/near_lamps/lamp_shells.h, but not for area lights, whose shadows are as soft as they are. Backs have no shadows.
float lampShadow(Light light) {
  int shadow = shadowOf(light);
  if (!hasNearLamps || shadow < 0 || !gl_FrontFacing) return 1.0;
  float visibility = vLampVisibility[shadow / 4][shadow % 4];
  return isArea(light) ? visibility : clamp(0.5 + 3.0 * (visibility - 0.5), 0.0, 1.0);
}
