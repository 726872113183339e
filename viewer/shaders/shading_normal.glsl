// Normal that a surface is shaded with before any bumps; needs material.glsl.

// Unit, on the side seen; `interpolated` is that of the vertices.
vec3 shadingNormal(vec3 interpolated) {
  vec4 triangle = FETCH(triangleNormals, triangleHere());
  bool usable = triangle.w < 0.5 && dot(interpolated, interpolated) > 1e-12;
  vec3 n = usable ? normalize(interpolated) : triangle.xyz;
  return gl_FrontFacing ? n : -n;
}
