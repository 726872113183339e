// Products of encoded light with the lobe of a rough surface. A lobe of a spread (1 less the length of its mean direction) is taken for
// the spherical Gaussian of integral 1 with the same mean direction.
// [1] Wang et al., "All-frequency rendering of dynamic, spatially-varying reflectance", 2009: products of spherical Gaussians.
// [2] Banerjee et al., "Clustering on the unit hypersphere using von Mises-Fisher distributions", 2005, Eq. 4.4.
const float encodedPi = 3.14159265;
const vec3 encodedLuminance = vec3(0.2126, 0.7152, 0.0722);

// Returns the sharpness of a lobe within 5 % [2].
float lobeSharpness(float spread) {
  float r = 1.0 - clamp(spread, 1e-4, 1.0);
  return r * (3.0 - r * r) / (1.0 - r * r);
}

// Returns the mean of exp(sharpness (w.d - 1)) over directions w in a lobe about an axis.
float meanOfGaussian(vec3 axis, float ofLobe, vec3 d, float sharpness) {
  float both = max(length(ofLobe * axis + sharpness * d), 1e-3), own = max(ofLobe, 1e-3);
  return own / (1.0 - exp(-2.0 * own)) * (1.0 - exp(-2.0 * both)) / both * exp(min(both - own - sharpness, 0.0));
}

// Returns the share of a lobe about an axis that lies over a surface, roughly.
float shareOver(vec3 normal, vec3 axis, float spread) {
  float width = sqrt(2.0 * spread) + 1e-3;
  return smoothstep(-width, width, dot(normal, axis));
}
