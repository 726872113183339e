#version 410 core
// Surfaces of a cube map's face for its lobes: means of two by two samples, black where the sky shows.
uniform sampler2D drawn;  // [row][column]: radiance, distance in m
uniform int side;         // texels of the face

layout(location = 0) out vec4 surfaces;  // rgb: radiance times alpha, a: share of the texel that surfaces cover

const float beyondScene = 1e15;  // m, as surroundings.glsl has it

void main() {
  surfaces = vec4(0.0);
  for (int k = 0; k < 4; ++k) {
    ivec2 place = 2 * ivec2(gl_FragCoord.xy) + ivec2(k % 2, k / 2);
    vec4 seen = texelFetch(drawn, place * textureSize(drawn, 0) / (2 * side), 0);
    if (seen.a < beyondScene) surfaces += 0.25 * vec4(seen.rgb, 1.0);
  }
}
