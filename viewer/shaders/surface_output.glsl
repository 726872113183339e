// Output of a surface: its radiance, and the factor of the light from behind it.
#ifdef GL_ES
// Whose factor alpha is, as GLSL ES has no second source of blending: channels are blended one by one. -1: nothing lies behind.
uniform int blendedChannel;
out vec4 outRadiance;

void showSurface(vec3 radiance, float depth, vec3 transmitted) {
  outRadiance = vec4(radiance, blendedChannel < 0 ? 1.0 : transmitted[blendedChannel]);
}
#else
layout(location = 0, index = 0) out vec4 outRadiance;     // alpha: distance from the eye
layout(location = 0, index = 1) out vec4 outTransmitted;  // factor of what lies behind

void showSurface(vec3 radiance, float depth, vec3 transmitted) {
  outRadiance = vec4(radiance, depth);
  outTransmitted = vec4(transmitted, 1.0);
}
#endif
