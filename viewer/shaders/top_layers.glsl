// Sheen and over that a clear coat, as kernels/transport/layer_funcs.cl has them but for their textures; needs scattering.glsl.
// [1] Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF".
uniform vec4 coatFactors;   // share of the surface, roughness
uniform vec4 sheenFactors;  // colour, roughness

const float coatF0 = 0.04;

// What the coat reflects of light from a direction of this cosine.
float coatAlbedo(float cosine) {
  float rise = schlickRise(cosine);
  vec2 first = coatFactors.y < smoothBelow ? vec2(1.0 - rise, rise) : lobeAlbedo(albedos, cosine, coatFactors.y).xy;
  return coatFactors.x * (coatF0 * first.x + first.y);
}

float sheenRoughness() { return max(sheenFactors.w, PRELIGHT_LEAST_SHEEN_ROUGHNESS); }

float sheenAlbedo(float cosine) { return lobeAlbedo(albedos, cosine, sheenRoughness()).z; }

// Share of light along the eye's direction that both leave to what lies below them.
float leftByLayers(float nv) {
  if (!hasTopLayers) return 1.0;
  return (1.0 - coatAlbedo(nv)) * (1.0 - largest(sheenFactors.rgb) * sheenAlbedo(nv));
}

float sheenFit(float x, float alpha) {  // [1] eq. 3
  float k = (1.0 - alpha) * (1.0 - alpha);
  float scale = mix(21.5473, 25.3245, k) / (1.0 + mix(3.82987, 3.32435, k) * pow(x, mix(0.19823, 0.16801, k)));
  return scale + mix(-1.97760, -1.27393, k) * x + mix(-4.32054, -4.85967, k);
}

float sheenLambda(float cosine, float alpha) {
  float x = clamp(cosine, 1e-4, 1.0);
  return x < 0.5 ? exp(sheenFit(x, alpha)) : exp(2.0 * sheenFit(0.5, alpha) - sheenFit(max(1.0 - x, 1e-6), alpha));
}

// BRDF value of both.
vec3 layersOfLight(vec3 n, vec3 toEye, vec3 toLight) {
  vec3 h = normalize(toEye + toLight);
  float nl = max(dot(n, toLight), 1e-4);
  float nv = max(dot(n, toEye), 1e-4);
  float nh = max(dot(n, h), 0.0);
  vec3 sum = vec3(0.0);
  if (coatFactors.y >= smoothBelow) {
    float a2 = coatFactors.y * coatFactors.y;
    a2 *= a2;
    sum += coatFactors.x * mix(coatF0, 1.0, schlickRise(dot(toEye, h))) * microfacets(nl, nv, nh, a2);
  }
  if (largest(sheenFactors.rgb) > 0.0) {
    float alpha = sheenRoughness() * sheenRoughness();
    float density = (2.0 + 1.0 / alpha) * pow(max(1.0 - nh * nh, 0.0), 0.5 / alpha) / (2.0 * pi);
    float masking = (1.0 + sheenLambda(nv, alpha) + sheenLambda(nl, alpha)) * 4.0 * nl * nv;
    sum += sheenFactors.rgb * (1.0 - coatAlbedo(nv)) * density / masking;
  }
  return sum;
}
