// Material of a fragment; needs variant.glsl. From the uniforms of Surface, its textures and vertex colours.
uniform vec4 baseColorFactor;
uniform vec4 surfaceFactors;     // metallic, roughness, transmission, alpha cutoff (< 0: none)
uniform vec4 translucency;       // of light that comes through from the other side: colour x share, share; 0: opaque
uniform vec3 emissionFactor;
uniform vec3 dielectricF0;       // reflectance at normal incidence of the non-metallic part
uniform float dielectricWeight;  // KHR_materials_specular.specularFactor
uniform int alphaBlend;
uniform int unlit;
uniform int doubleSided;
uniform int firstTriangle;
uniform sampler2D baseColorTexture;
uniform sampler2D metallicRoughnessTexture;
uniform sampler2D emissiveTexture;
uniform samplerBuffer triangleNormals;  // see RenderScene

struct FragmentMaterial {
  vec3 base;
  float alpha;
  float metallic;
  float roughness;
  float transmission;
  vec3 albedo;  // Lambertian
  vec3 through;  // the same for light that leaves on the other side
  vec3 f0;
  vec3 emission;
};

FragmentMaterial readMaterial(vec4 texCoords, vec2 emissiveTexCoord, vec4 vertexColor) {
  vec4 base = baseColorFactor;
  if (hasBaseColorTexture) base *= texture(baseColorTexture, texCoords.xy);
  if (hasVertexColors) base *= vertexColor;
  vec4 factors = vec4(1.0);
  if (hasMetallicRoughnessTexture) factors = texture(metallicRoughnessTexture, texCoords.zw);
  FragmentMaterial m;
  m.base = base.rgb;
  m.alpha = base.a;
  float glass = hasGlass ? surfaceFactors.z : 0.0;
  vec4 passing = hasTranslucency ? translucency : vec4(0.0);
  m.metallic = hasGloss ? surfaceFactors.x * factors.b : 0.0;
  m.roughness = surfaceFactors.y * factors.g;
  m.transmission = glass * (1.0 - m.metallic);
  m.albedo = m.base * (1.0 - m.metallic) * (1.0 - glass) * (1.0 - passing.a);
  m.through = min(passing.rgb, vec3((1.0 - m.metallic) * (1.0 - glass) * passing.a));
  m.f0 = mix(dielectricF0 * dielectricWeight, m.base, m.metallic);
  m.emission = hasEmission ? emissionFactor : vec3(0.0);
  if (hasEmissiveTexture) m.emission *= texture(emissiveTexture, emissiveTexCoord).rgb;
  return m;
}
