// A place on a surface with all that light does there; needs scattering.glsl, top_layers.glsl, glass_lobe.glsl and around.glsl.
struct Place {
  Scattering s;
  TopLayers top;
  // Copies of s and top for lamps. A lamp of no extent would make a mirror's lobe infinitely small: roughness is kept above 0.045.
  Scattering byLamps;
  TopLayers topByLamps;
  int triangle;
  Normals n;
  vec3 toEye;
  vec3 wo;       // to the eye, in the frame of the surface
  float metallic;
  float nv;      // cosine of that with the reflecting normal
  float coated;  // what the clear coat reflects of it
  vec3 hidden;   // mean radiance of what hides the sky, times its share
  float around;  // how much is known of what lies around, 0..1
  float left;    // what coat and sheen leave of it to what lies below them
};

// Through diffuse transfer, plain dielectrics reflect no lamps, of which they would show highlights without shadows, but where shadow
// maps or what lies around are known.
const bool layerReflectsLamps = hasLayer && (hasFurtherLobes || hasShadowMaps || reflectionRule != reflectionOffMetals);
const bool reflectsLamps = !isSender && (hasGloss || layerReflectsLamps || (hasLayer && hasLocalReflections));
const float leastRoughness = 0.0447213595;  // its square: 0.002

// Whether a place knows enough of what lies around to tell which lamps its layer reflects.
bool knowsAround(Place p) { return p.around >= 0.5; }

Place placeOf(FragmentMaterial m, vec4 texCoords, int triangle, vec3 even, Normals n, vec3 toEye) {
  Place p;
  Stretch stretch = readStretch(texCoords, even, n.reflecting, vPosition, triangle);
  p.triangle = triangle;
  p.n = n;
  p.toEye = toEye;
  p.metallic = m.metallic;
  p.nv = max(dot(n.reflecting, toEye), 0.0);
  p.top = readTopLayers(texCoords, even, n.geometric, toEye, vPosition, triangle);
  p.topByLamps = p.top;
  p.topByLamps.coatRoughness = max(p.top.coatRoughness, smoothBelow);
  p.s = scatteringOf(m, stretch, layerCovers);
  p.hidden = vec3(0.0);
  p.around = hasGloss || hasLayer ? aroundKnown(vPosition) : 0.0;
  p.byLamps = scatteringOf(m, stretch, layerReflectsLamps || knowsAround(p));
  if (hasFilm) {
    addFilm(texCoords, p.top.coat, m, p.s);
    p.byLamps = p.s;
  }
  if (hasMeasured && reflectionRule == reflectionThroughTransfer) {
    if (measured >= 0) {  // the body was measured with what its layer takes
      p.s.layer = vec3(0.0);
      p.s.bodyGain = 1.0;
    }
  }
  p.byLamps.roughness = max(p.byLamps.roughness, leastRoughness);
  p.wo = vec3(inFrame(p.s, n.reflecting, toEye).xy, p.nv);
  float onCoat = max(dot(p.top.coatNormal, toEye), 0.0);
  p.coated = hasTopLayers ? coatAlbedo(p.top, onCoat) : 0.0;
  p.left = leftByLayers(p.top, onCoat, p.nv);
  return p;
}

// Returns the albedos for light that arrives evenly: those of the body and, with the mean of that light, of the sheen.
Body bodyOf(Place p) {
  Body body = Body(p.s.diffuse, p.s.transmitted);
  if (layerCovers || hasTopLayers) {
    body.albedo *= p.left * passage(p.s, p.wo);
    body.through *= p.left * passedFromBehind(p.s, p.wo);
  }
  if (hasTopLayers) body.albedo += p.top.sheen * sheenAlbedo(p.top, p.nv) * (1.0 - p.coated);
  return body;
}
