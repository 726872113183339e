// Rough reflections that are wider one way than the other (KHR_materials_anisotropy), as kernels/transport/interaction_funcs.cl
// and material_funcs.cl have them; needs material.glsl and normal_map.glsl.
uniform vec4 anisotropy;  // strength, cosine and sine of its rotation, 1 where it has a texture
uniform sampler2D anisotropyTexture;  // RG direction, B strength
uniform vec4 anisotropyU;
uniform vec4 anisotropyV;

struct Stretch {
  vec3 along;   // unit, the way in which the surface n is rougher
  vec3 across;  // perpendicular to that and to n
  float amount;  // 0: none
};

// even: normal of the side that is seen, without bumps; n: with them.
Stretch readStretch(vec4 texCoords, vec3 even, vec3 n, vec3 point, int triangle) {
  Stretch s = Stretch(vec3(0.0), vec3(0.0), 0.0);
  if (!hasAnisotropy) return s;
  vec3 texel = vec3(1.0, 0.5, 1.0);
  if (hasAnisotropy) {
    if (anisotropy.w > 0.5) texel = texture(anisotropyTexture, texturePlace(texCoords, anisotropyU, anisotropyV)).rgb;
  }
  vec2 way = anisotropy.w > 0.5 ? 2.0 * texel.rg - 1.0 : vec2(1.0, 0.0);
  if (dot(way, way) < 1e-4) return s;  // no byte tells 0 exactly
  vec3 x, y;
  if (!tangentsAt(gl_FrontFacing ? even : -even, point, triangle, x, y)) return s;
  vec3 turned = (anisotropy.y * way.x - anisotropy.z * way.y) * x + (anisotropy.z * way.x + anisotropy.y * way.y) * y;
  vec3 inPlane = turned - dot(turned, n) * n;
  if (dot(inPlane, inPlane) <= 1e-9) return s;
  s.along = normalize(inPlane);
  s.across = cross(n, s.along);
  float strength = anisotropy.x * texel.b;
  s.amount = strength * strength;
  return s;
}

const int tilts = 16;

// One of the microfacets that are wider along one direction than across, tilted along it, each as likely: the direction that it
// mirrors to the eye and its weight; 0: it is not seen. Reflections of the tilts are blurred as by stretchedBlur().
float tiltedWay(int k, vec3 n, vec3 toEye, vec3 along, vec2 widths, out vec3 way) {
  float u = (2.0 * float(k) + 1.0) / float(tilts) - 1.0;
  vec3 h = normalize(n + widths.x * u * inversesqrt(1.0 - u * u) * along);  // quantiles of the slopes of GGX
  float facing = dot(h, toEye);
  way = reflect(-toEye, h);
  return facing <= 0.0 || dot(n, way) <= 0.0 ? 0.0 : facing / max(dot(n, h), 1e-3);
}

// Roughness of the blur across, or of what lets none of the tilts show by itself.
float stretchedBlur(vec2 widths) { return sqrt(max(widths.y, 0.18 * widths.x)); }
