// Reflection of baked light that is known by direction; needs place.glsl, glass_lobe.glsl and the technique's ambient text, which
// answers, if it defines KNOWS_BAKED_LOBES:
// - bakedLampCount, bakedLamp(): lamps that stand for the strongest light, as perpendicular irradiance, with their shadows;
// - bakedInLobe(): mean radiance in a lobe, of all other light;
// - bakedIrradiance(): irradiance of all of it.
// Lamps have the shape of the surface's own lobes: these are narrower than the spherical Gaussians of their spread.
#ifdef KNOWS_BAKED_LOBES

// Returns the share of baked light that lobes reflect as such: not that of the sky, which they show themselves.
vec3 shareOfBaked(Place p, Visibility seen) {
  return clamp(p.hidden * pi / max(bakedIrradiance(seen, p.n.bumped), vec3(1e-20)), vec3(0.0), vec3(1.0));
}

vec3 bakedRadiance(Place p, Visibility seen, vec3 axis, float spread) {
  return shareOfBaked(p, seen) * bakedInLobe(seen, axis, spread);
}

// Returns the share of a lamp's perpendicular irradiance that all lobes send to the eye.
vec3 lampInLobes(Place p, vec3 toLamp) {
  vec3 n = p.n.reflecting;
  float cosine = dot(n, toLamp);
  if (cosine <= 0.0 || dot(p.n.geometric, toLamp) <= 0.0) return vec3(0.0);
  vec3 sum = p.left * cosine * glossyOfLight(p.byLamps, n, p.toEye, toLamp);
  if (hasGlass) sum += p.left * roughGlassOfLight(p.byLamps, n, p.toEye, toLamp);
  if (hasTopLayers) {
    TopLayers coat = p.topByLamps;
    coat.sheen = vec3(0.0);  // which reflects the irradiance
    sum += layersOfLight(coat, n, p.toEye, toLamp, 1.0);
  }
  return sum;
}

vec3 bakedHighlights(Place p, Visibility seen) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < bakedLampCount; ++i) {
    vec3 toLamp;
    vec3 irradiance = bakedLamp(seen, i, toLamp);
    if (irradiance != vec3(0.0)) sum += irradiance * lampInLobes(p, toLamp);
  }
  return shareOfBaked(p, seen) * sum;
}

#else

vec3 bakedRadiance(Place p, Visibility seen, vec3 axis, float spread) { return vec3(0.0); }
vec3 bakedHighlights(Place p, Visibility seen) { return vec3(0.0); }

#endif
