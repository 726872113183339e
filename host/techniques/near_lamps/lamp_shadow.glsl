// What shells of distance leave of a near lamp's light; needs lights.glsl.

// sharpened() of host/techniques/near_lamps/lamp_shells.h, as area lights are already. Backs have no shadows.
float lampShadow(Light light) {
  int shadow = shadowOf(light);
  if (!hasNearLamps || shadow < 0 || !gl_FrontFacing) return 1.0;
  float visibility = vLampVisibility[shadow / 4][shadow % 4];
  return isArea(light) ? visibility : clamp(0.5 + 3.0 * (visibility - 0.5), 0.0, 1.0);
}
