// Reflection of lamps, which shine without shadow maps; needs place.glsl and lights.glsl.

// The modified Phong BRDF of phongExponent() in viewer/techniques/glossy/specular_lobes.h.
vec3 phongBrdf(Scattering s, vec3 n, vec3 toEye, vec3 toLight) {
  float alpha = s.roughness * s.roughness;
  float exponent = 2.0 / (alpha * alpha) - 2.0;
  float cosine = clamp(dot(reflect(-toEye, n), toLight), 1e-6, 1.0);
  return s.f0 * (exponent + 2.0) / (2.0 * pi) * pow(cosine, exponent);
}

// Returns the radiance of an area light in a lobe with a reflectance of 1.
vec3 shapeInLobe(Light light, vec3 n, vec3 toEye, float roughness) {
  vec2 first = lobeAlbedo(albedos, max(dot(n, toEye), 0.0), roughness).xy;
  float share = lobeShare(shapeFrom(light, vPosition), n, toEye, max(roughness * roughness, 0.002)) * (first.x + first.y);
  return share * light.intensityRange.rgb;
}

// An area light in the lobes of metal, layer, glass and coat; Fresnel's reflectance is that of its mean direction.
vec3 shapeInLobes(Light light, Place p, vec3 toLight, float ofCoat) {
  vec3 between = p.toEye + toLight;
  float cosine = dot(p.toEye, between) * inversesqrt(max(dot(between, between), 1e-12));
  vec3 reflectance = facetReflectance(p.byLamps, cosine);
  if (hasGlass) reflectance += p.s.glass * facetOfGlass(p.s, cosine);
  vec3 sum = p.left * reflectance * shapeInLobe(light, p.n.reflecting, p.toEye, p.byLamps.roughness);
  if (hasTopLayers)
    sum += ofCoat * p.top.coat * coatReflectance(cosine) *
           shapeInLobe(light, p.top.coatNormal, p.toEye, p.topByLamps.coatRoughness);
  return sum;
}

// irradiance, toLight: on the surface with its bumps. ofLayer, ofCoat: shares of what these reflect.
vec3 mirroredLight(Light light, Place p, vec3 irradiance, vec3 toLight, float ofLobes, float ofCoat) {
  vec3 n = p.n.reflecting, sum = vec3(0.0);
  float radius;
  if (hasNormalTexture) irradiance = irradianceOn(light, vPosition, n, toLight, radius);
  bool area = isArea(light);
  bool isPhong = phongLobe || (reflectionRule == reflectionThroughTransfer && lobeIsBrdf != 0);
  sum = p.left * irradiance * (isPhong ? phongBrdf(p.byLamps, n, p.toEye, toLight) : glossyOfLight(p.byLamps, n, p.toEye, toLight));
  if (hasAreaLights) {
    if (area) sum = shapeInLobes(light, p, toLight, ofCoat);
  }
  sum *= ofLobes;
  if (!hasTopLayers && !hasGlass) return sum;
  vec3 way;
  vec3 facing = perpendicularIrradiance(light, vPosition, way);
  bool above = dot(n, way) > 0.0 && dot(p.n.geometric, way) > 0.0;
  if (hasGlass && !area && (above || (hasRoughGlass && dot(n, way) < 0.0)))
    sum += ofLobes * p.left * facing * roughGlassOfLight(p.byLamps, n, p.toEye, way);
  if (hasTopLayers && above) sum += facing * layersOfLight(p.topByLamps, n, p.toEye, way, area ? 0.0 : ofCoat);
  return sum;
}
