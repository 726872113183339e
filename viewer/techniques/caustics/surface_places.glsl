// Where the surface of every pixel is, as surface_places.frag writes it: xyz its position, w the number of its triangle
// + 1, negative on the back; w 0: none.
uniform samplerBuffer triangleNormals;  // see RenderScene

// Width of a pixel on the plane at unit depth; of an orthographic picture, anywhere.
uniform float pixelWidth;

// Unit, on the side seen.
vec3 normalOfPlace(float place) {
  return sign(place) * texelFetch(triangleNormals, int(abs(place)) - 1).xyz;
}

// Metres across a pixel, at a position.
float widthOfPixel(vec3 position) {
  return eye.w > 0.5 ? pixelWidth * dot(position - eye.xyz, forward.xyz) : pixelWidth;
}

// Area of the surface of normal n that a pixel sees, m2: that of its width squared divided by the cosine to the eye
// (Larsen 2004, Eq. 12.2, multiplies; a slanted surface shows more of itself), and exact off the picture's centre.
float areaOfPixel(vec3 position, vec3 n) {
  float width = widthOfPixel(position);
  vec3 way = position - eye.xyz;
  float cosine = eye.w > 0.5 ? abs(dot(n, way)) / dot(way, forward.xyz) : abs(dot(n, forward.xyz));
  return width * width / max(cosine, 1e-3);
}
