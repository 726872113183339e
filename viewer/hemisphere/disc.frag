#version 410 core
// A direction of a receiver's disc that a triangle may hide (disc.vert).
uniform ivec4 tiles;              // x: texels a side of a picture
uniform int orthographic;         // 1; 0: stereographic
uniform samplerBuffer radiance;   // [triangle][3], W/(m2 sr)
uniform int showsRadiance;        // 1: the nearest surface's radiance, with depth; 0: how much of the sky is covered
uniform float farthest;           // scene coordinates, of depths
uniform usamplerBuffer holes;     // [coverage][4], bits: coordinates of three corners and cutoff; alpha of corners, 1 blended; texture
uniform samplerBuffer alphas;     // alpha of all textures

flat in vec3 side0, side1, side2, tolerances, surface, ownNormal;
flat in ivec2 tile;
flat in uint triangle, coverage;

layout(location = 0) out vec4 seen;

// Returns a texel's number along an axis; `mode`: kernels/transport/alpha_funcs.cl, wrapTexel.
int wrapped(int i, int size, uint mode) {
  if (mode == 1u) return clamp(i, 0, size - 1);
  int period = mode == 2u ? 2 * size : size;
  int at = i >= 0 ? i % period : period - 1 - (-1 - i) % period;  // GLSL leaves % of negative numbers undefined
  return at < size ? at : period - 1 - at;
}

float alphaAt(uvec4 texture, ivec2 at) {
  ivec2 size = ivec2(texture.yz);
  uint modes = texture.w;
  return texelFetch(alphas, int(texture.x) + wrapped(at.y, size.y, (modes >> 2) & 3u) * size.x + wrapped(at.x, size.x, modes & 3u)).x;
}

// Returns the alpha of a texture: x: first texel, yz: size, w: ways to wrap, 16: no filter.
float textureAlpha(uvec4 texture, vec2 uv) {
  if (texture.y == 0u) return 1.0;
  bool nearest = (texture.w & 16u) != 0u;
  vec2 at = uv * vec2(texture.yz) - (nearest ? 0.0 : 0.5);
  at -= 1048576.0 * trunc(at / 1048576.0);  // the fmod of kernels/transport/alpha_funcs.cl, which keeps the sign, as mod() does not
  at = mix(at, vec2(0.0), isnan(at));
  vec2 base = floor(at), f = at - base;
  ivec2 i = ivec2(base);
  if (nearest) return alphaAt(texture, i);
  return mix(mix(alphaAt(texture, i), alphaAt(texture, i + ivec2(1, 0)), f.x),
             mix(alphaAt(texture, i + ivec2(0, 1)), alphaAt(texture, i + ivec2(1, 1)), f.x), f.y);
}

// Returns how much of the triangle is there at weights of its corners, 0..1.
float coverageAt(vec3 weights) {
  if (coverage == 0u) return 1.0;
  int record = 4 * int(coverage - 1u);
  vec4 a = uintBitsToFloat(texelFetch(holes, record)), b = uintBitsToFloat(texelFetch(holes, record + 1)),
       c = uintBitsToFloat(texelFetch(holes, record + 2));
  vec2 uv = weights.x * a.xy + weights.y * a.zw + weights.z * b.xy;
  float alpha = dot(weights, c.xyz) * textureAlpha(texelFetch(holes, record + 3), uv);
  return b.w > 0.5 ? clamp(alpha, 0.0, 1.0) : (alpha >= b.z ? 1.0 : 0.0);
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy) - tile;
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(tiles.x)))) discard;
  vec2 p = (2.0 * vec2(texel) + 1.0) / float(tiles.x) - 1.0;
  float r2 = dot(p, p);
  if (r2 >= 1.0) discard;
  vec3 direction = orthographic == 1 ? vec3(p, sqrt(1.0 - r2)) : vec3(2.0 * p, 1.0 - r2) / (1.0 + r2);
  vec3 weights = vec3(1.0, 0.0, 0.0);
  float nearness = 1e30;
  if (ownNormal != vec3(0.0)) {
    if (dot(direction, ownNormal) > 0.0) discard;
  } else {
    vec3 inside = vec3(dot(side0, direction), dot(side1, direction), dot(side2, direction));
    if (any(lessThan(inside, -tolerances))) discard;
    weights = max(inside, 0.0);
    weights /= max(weights.x + weights.y + weights.z, 1e-37);
    nearness = dot(surface, direction);
  }
  float share = coverageAt(weights);
  if (share <= (showsRadiance == 1 ? 0.5 : 0.0)) discard;
  int first = 3 * int(triangle);
  seen = showsRadiance == 1
             ? vec4(weights.x * texelFetch(radiance, first).xyz + weights.y * texelFetch(radiance, first + 1).xyz +
                        weights.z * texelFetch(radiance, first + 2).xyz, 0.0)
             : vec4(share);
  gl_FragDepth = clamp(1.0 / (max(nearness, 1e-30) * farthest), 0.0, 1.0);
}
