// Sheen and over that a clear coat, as kernels/transport/layer_funcs.cl has them; needs scattering.glsl and normal_map.glsl.
uniform vec4 coatFactors;   // share of the surface, roughness, scale of its normal texture's x and y (0: there is none)
uniform vec4 sheenFactors;  // colour, roughness
uniform sampler2D coatTexture;            // R
uniform sampler2D coatRoughnessTexture;   // G
uniform sampler2D coatNormalTexture;
uniform sampler2D sheenColorTexture;
uniform sampler2D sheenRoughnessTexture;  // A
uniform vec4 coatU;
uniform vec4 coatV;
uniform vec4 coatRoughnessU;
uniform vec4 coatRoughnessV;
uniform vec4 coatNormalU;
uniform vec4 coatNormalV;
uniform vec4 sheenColorU;
uniform vec4 sheenColorV;
uniform vec4 sheenRoughnessU;
uniform vec4 sheenRoughnessV;

const float coatF0 = PRELIGHT_COAT_F0;

struct TopLayers {
  float coat;  // share of the surface
  float coatRoughness;
  vec3 coatNormal;
  vec3 sheen;
  float sheenRoughness;
};

// The coat knows no bumps but its own. even: normal of the side that is seen, without bumps.
TopLayers readTopLayers(vec4 texCoords, vec3 even, vec3 geometric, vec3 toEye, vec3 point, int triangle) {
  TopLayers t = TopLayers(0.0, 0.0, even, vec3(0.0), 0.0);
  if (!hasTopLayers) return t;
  t.coat = coatFactors.x;
  t.coatRoughness = coatFactors.y;
  t.sheen = sheenFactors.rgb;
  t.sheenRoughness = sheenFactors.w;
  if (hasLayerTextures) {
    t.coat *= texture(coatTexture, texturePlace(texCoords, coatU, coatV)).r;
    t.coatRoughness *= texture(coatRoughnessTexture, texturePlace(texCoords, coatRoughnessU, coatRoughnessV)).g;
    t.sheen *= texture(sheenColorTexture, texturePlace(texCoords, sheenColorU, sheenColorV)).rgb;
    t.sheenRoughness *= texture(sheenRoughnessTexture, texturePlace(texCoords, sheenRoughnessU, sheenRoughnessV)).a;
    if (coatFactors.z != 0.0) {
      float side = gl_FrontFacing ? 1.0 : -1.0;
      vec3 texel = 2.0 * texture(coatNormalTexture, texturePlace(texCoords, coatNormalU, coatNormalV)).rgb - 1.0;
      t.coatNormal = side * turnedNormal(side * even, texel, coatFactors.z, point, triangle);
    }
  }
  t.coatNormal = visibleNormal(t.coatNormal, geometric, toEye);
  t.sheenRoughness = max(t.sheenRoughness, PRELIGHT_LEAST_SHEEN_ROUGHNESS);
  return t;
}

// What the coat reflects of light from a direction of this cosine with its normal.
float coatAlbedo(TopLayers t, float cosine) {
  return albedoOfCoat(albedos, t.coat, t.coatRoughness, t.coatRoughness < smoothBelow, cosine);
}

float sheenAlbedo(TopLayers t, float cosine) { return lobeAlbedo(albedos, cosine, t.sheenRoughness).z; }

// Share of light along the eye's direction that both leave to what lies below them, given its cosines with the coat's normal
// and the surface's.
float leftByLayers(TopLayers t, float onCoat, float nv) {
  if (!hasTopLayers) return 1.0;
  return (1.0 - coatAlbedo(t, onCoat)) * (1.0 - largest(t.sheen) * sheenAlbedo(t, nv));
}

// Reflection of coat and sheen, times the cosine of the light. coatShare: share of the coat's reflection.
vec3 layersOfLight(TopLayers t, vec3 n, vec3 toEye, vec3 toLight, float coatShare) {
  vec3 h = normalize(toEye + toLight);
  vec3 sum = vec3(0.0);
  float cl = dot(t.coatNormal, toLight), cv = dot(t.coatNormal, toEye);
  if (t.coatRoughness >= smoothBelow && cl > 0.0 && cv > 0.0) {
    float ch = max(dot(t.coatNormal, h), 0.0);
    sum += coatShare * t.coat * coatReflectance(dot(toEye, h)) *
           microfacets(max(cl, 1e-4), max(cv, 1e-4), ch, t.coatRoughness * t.coatRoughness) * cl;
  }
  if (largest(t.sheen) > 0.0) {
    float nl = max(dot(n, toLight), 1e-4);
    float nv = max(dot(n, toEye), 1e-4);
    float nh = max(dot(n, h), 0.0);
    float lobe = sheenLobe(nv, nl, nh, t.sheenRoughness * t.sheenRoughness);
    sum += t.sheen * (1.0 - coatAlbedo(t, max(cv, 0.0))) * lobe;
  }
  return sum;
}
