#version 410 core
// Surfaces of a cube map's face for its lobes: means of two by two samples, black where the sky shows.
uniform sampler2D drawn;  // [row][column] of twice the side: radiance, distance in m

layout(location = 0) out vec4 surfaces;  // rgb: radiance times alpha, a: share of the texel that surfaces cover

const float beyondScene = 1e15;  // m, as surroundings.glsl has it

void main() {
  surfaces = vec4(0.0);
  for (int k = 0; k < 4; ++k) {
    vec4 seen = texelFetch(drawn, 2 * ivec2(gl_FragCoord.xy) + ivec2(k % 2, k / 2), 0);
    if (seen.a < beyondScene) surfaces += 0.25 * vec4(seen.rgb, 1.0);
  }
}
