#version 410 core
// Depth as shadows.glsl has it: greater is nearer, affine across a plane, and as precise far away as near.
uniform vec4 axisY;  // w: nearest depth, m; 0: orthographic
uniform vec4 alpha;  // factor, cutoff (< 0: opaque)
uniform sampler2D baseColorTexture;

in vec2 vTexCoord;
in float vAlpha;

void main() {
  if (alpha.y >= 0.0 && alpha.x * vAlpha * texture(baseColorTexture, vTexCoord).a < alpha.y) discard;
  gl_FragDepth = axisY.w > 0.0 ? axisY.w * gl_FragCoord.w : 1.0 - gl_FragCoord.z;
}
