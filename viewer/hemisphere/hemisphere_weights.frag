#version 410 core
// A texel of receivers' pictures, times what it counts.
uniform sampler2D seen;          // as hemisphere.frag leaves it
uniform samplerBuffer weights;   // [face][texel], four
uniform ivec4 tile;              // x: texels a side of a picture, y: where the face begins, z: 1 of radiance, 0 of what is open

layout(location = 0) out vec4 product;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 s = texelFetch(seen, at, 0);
  ivec2 texel = at % tile.x;
  vec4 weight = texelFetch(weights, tile.y + texel.y * tile.x + texel.x);
  product = tile.z == 1 ? vec4(s.rgb * weight.x, 0.0) : s.a * weight;
}
