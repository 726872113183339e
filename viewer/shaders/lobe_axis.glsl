// Where the lobe of a rough surface lies: not about the mirrored direction, as masking and the horizon turn wide lobes to the
// normal; needs scattering.glsl.
struct LobeAxis {
  vec3 direction;  // the light's mean direction, unit
  float spread;    // 1 less the length of the mean direction
};

// Returns the axis of a lobe about n of the reflectances f0 along the normal, f90 at grazing angles and `later` of light that does not
// leave microfacets at the first bounce, which leaves in all directions.
LobeAxis lobeAxis(vec3 n, vec3 toEye, float roughness, float f0, float f90, float later) {
  vec3 mirrored = reflect(-toEye, n);
  if (roughness < smoothBelow) return LobeAxis(mirrored, 0.0);
  float cosine = clamp(dot(n, toEye), 0.0, 1.0), sine = sqrt(1.0 - cosine * cosine);
  vec2 first = lobeAlbedo(albedos, cosine, roughness).xy;
  vec4 lean = lobeLean(albedos, cosine, roughness);
  float last = later * max(1.0 - first.x - first.y, 0.0);
  float whole = max(f0 * first.x + f90 * first.y + last, 1e-6);
  float along = 1.0 - (f0 * lean.x + f90 * lean.z + last * (1.0 - 2.0 / 3.0 * cosine)) / whole;
  float aside = (f0 * lean.y + f90 * lean.w + last * 2.0 / 3.0 * sine) / whole;
  vec3 inward = sine > 1e-3 ? (n - cosine * mirrored) / sine : vec3(0.0);
  float size = length(vec2(along, aside));
  return LobeAxis(normalize(along * mirrored + aside * inward), max(1.0 - size, 0.0));
}

float meanOf(vec3 rgb) { return dot(rgb, vec3(1.0 / 3.0)); }

LobeAxis lobeAxis(vec3 n, vec3 toEye, Scattering s) { return lobeAxis(n, toEye, s.roughness, meanOf(s.f0), meanOf(s.f90), meanOf(s.later)); }
