// Light maps whose places belong to the corners of triangles; needs triangles.glsl.
uniform sampler2DArray lightMaps;       // radiance before albedo, or irradiance
uniform samplerBuffer lightMapCorners;  // [face][3] texels from the upper left; x < 0: the face has none
uniform int frontFaces;                 // fronts of triangles, then their backs

// Irradiance at a point of a triangle's side: bilinear by hand, as textures round weights to 1/256.
vec3 lightMapIrradiance(int triangle, bool front, vec3 point) {
  int face = 3 * (front ? triangle : frontFaces + triangle);
  vec2 first = texelFetch(lightMapCorners, face).xy;
  if (first.x < 0.0) return vec3(0.0);
  ivec3 corners = ivec3(texelFetch(triangleCorners, triangle).xyz);
  vec3 weights = max(weightsOfCorners(corners, point), vec3(0.0));
  weights /= weights.x + weights.y + weights.z;
  vec2 place = weights.x * first + weights.y * texelFetch(lightMapCorners, face + 1).xy +
               weights.z * texelFetch(lightMapCorners, face + 2).xy - 0.5;
  ivec2 low = ivec2(floor(place));
  ivec2 high = min(low + 1, textureSize(lightMaps, 0).xy - 1);
  vec2 share = place - vec2(low);
  vec3 upper = mix(texelFetch(lightMaps, ivec3(low, 0), 0).rgb, texelFetch(lightMaps, ivec3(high.x, low.y, 0), 0).rgb,
                   share.x);
  vec3 lower = mix(texelFetch(lightMaps, ivec3(low.x, high.y, 0), 0).rgb, texelFetch(lightMaps, ivec3(high, 0), 0).rgb,
                   share.x);
  return mix(upper, lower, share.y);
}
