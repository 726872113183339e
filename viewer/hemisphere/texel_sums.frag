#version 410 core
// The sum of consecutive texels along a row or a column.
uniform sampler2D texels;
uniform ivec4 kernel;  // xy: way from one to the next, z: how many

layout(location = 0) out vec4 sum;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * (ivec2(1) + (kernel.z - 1) * kernel.xy);
  sum = vec4(0.0);
  for (int k = 0; k < kernel.z; ++k) sum += texelFetch(texels, first + k * kernel.xy, 0);
}
