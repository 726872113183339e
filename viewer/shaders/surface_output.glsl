// What a surface leaves in the picture: its radiance, and the factor of what lies behind it.
#ifdef GL_ES
uniform int blendPart;  // 0: the radiance, 1: the factor, as GLSL ES has no second source of blending
out vec4 outRadiance;

void showSurface(vec3 radiance, float depth, vec3 transmitted) {
  outRadiance = vec4(blendPart == 0 ? radiance : transmitted, 1.0);
}
#else
layout(location = 0, index = 0) out vec4 outRadiance;     // alpha: distance from the eye
layout(location = 0, index = 1) out vec4 outTransmitted;  // factor of what lies behind

void showSurface(vec3 radiance, float depth, vec3 transmitted) {
  outRadiance = vec4(radiance, depth);
  outTransmitted = vec4(transmitted, 1.0);
}
#endif
