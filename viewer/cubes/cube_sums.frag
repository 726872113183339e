#version 410 core
// A coefficient of SH: the sum of what rows of texels give to it.
uniform sampler2D rows;  // [face and row][i]

layout(location = 0) out vec4 coefficient;

void main() {
  vec3 sum = vec3(0.0);
  for (int line = 0; line < textureSize(rows, 0).y; ++line) sum += texelFetch(rows, ivec2(int(gl_FragCoord.x), line), 0).rgb;
  coefficient = vec4(sum, 0.0);
}
