// Normals that a texture bumps; needs variant.glsl and material.glsl.
uniform sampler2D normalTexture;
uniform vec4 normalU;
uniform vec4 normalV;
uniform float normalScale;  // of the texture's x and y; 0: there is none

// Unit normal of a front around its own, n, at coordinates of the texture; the tangent is the file's or, where that is
// 0, the way in which u grows on the triangle.
vec3 mappedNormal(vec3 n, vec3 point, vec2 coord, vec4 tangent) {
  if (!hasNormalTexture) return n;
  vec3 px = dFdx(point);
  vec3 py = dFdy(point);
  vec2 cx = dFdx(coord);
  vec2 cy = dFdy(coord);
  if (normalScale == 0.0) return n;
  vec3 texel = 2.0 * texture(normalTexture, coord).rgb - 1.0;
  texel.xy *= normalScale;
  if (dot(tangent.xyz, tangent.xyz) < 1e-12) {
    float turn = cx.x * cy.y - cy.x * cx.y < 0.0 ? -1.0 : 1.0;
    vec3 alongU = turn * (cy.y * px - cx.y * py);
    vec3 alongV = turn * (cx.x * py - cy.x * px);
    tangent = vec4(alongU, dot(cross(n, alongU), alongV) > 0.0 ? -1.0 : 1.0);  // v grows downwards
  }
  vec3 along = tangent.xyz - dot(tangent.xyz, n) * n;
  if (dot(along, along) <= 1e-18 * dot(tangent.xyz, tangent.xyz)) return n;
  along = normalize(along);
  vec3 mapped = texel.x * along + texel.y * (tangent.w < 0.0 ? -1.0 : 1.0) * cross(n, along) + texel.z * n;
  return dot(mapped, mapped) > 1e-12 ? normalize(mapped) : n;
}
