// Reflection and transmission of the surroundings; needs place.glsl, lobe_axis.glsl, glossy.glsl and the technique's ambient text.

// Mean radiance in a lobe: of the sky past what the technique knows of the way, and of what hides it.
vec3 radiancePastTechnique(Place p, Visibility seen, vec3 direction, float roughness, float spread) {
  vec3 radiance = radianceFrom(seen, direction, roughness, spread);
  if (p.hidden == vec3(0.0)) return radiance;
  return radiance + p.hidden * (1.0 - skyVisibility(seen, direction, roughness)) / max(1.0 - seen.ofSky, 0.1);
}

// Mean radiance in a lobe: of what lies around where that is known.
vec3 radianceInLobe(Place p, Visibility seen, vec3 direction, float roughness, float spread) {
  vec3 around = p.around > 0.0 ? radianceAround(vPosition, direction, spread) : vec3(0.0);
  if (p.around >= 1.0) return around;
  return mix(radiancePastTechnique(p, seen, direction, roughness, spread), around, p.around);
}

// In a lobe of a roughness about n. reflectance: of an even sky; f0: along the normal. Of glossy transfer, lobes that its bands hold
// come from its matrices and narrower ones from the sky.
vec3 reflectedInLobe(Place p, Visibility seen, vec3 reflectance, vec3 f0, vec3 n, float roughness, LobeAxis axis) {
  float through = shareThroughTransfer(roughness);
  vec3 sum = vec3(0.0);
  if (reflectionRule == reflectionThroughTransfer) {
    if (lobeIsBrdf != 0) reflectance = f0;
    if (through > 0.0) sum = through * reflectThroughTransfer(reflectance, roughness, p.triangle, vPosition, n, p.toEye);
  }
  if (through < 1.0) sum += (1.0 - through) * reflectance * radianceInLobe(p, seen, axis.direction, roughness, axis.spread);
  return sum;
}

vec3 reflectedStretched(Place p, Visibility seen, vec3 reflectance) {
  vec3 sum = vec3(0.0);
  float weights = 0.0, blur = stretchedBlur(p.s.widths), spread = spreadOfRoughness(blur);
  for (int k = 0; k < tilts; ++k) {
    vec3 way;
    float weight = tiltedWay(k, p.n.reflecting, p.toEye, p.s.along, p.s.widths, way);
    if (weight <= 0.0) continue;
    sum += weight * radianceInLobe(p, seen, way, blur, spread);
    weights += weight;
  }
  return reflectance * sum / max(weights, 1e-6);
}

// Metal and layer.
vec3 reflectedByFacets(Place p, Visibility seen) {
  vec3 n = p.n.reflecting;
  if (reflectionRule == reflectionThroughTransfer) {
    if (hasMeasured) {
      if (measured >= 0) return reflectMeasured(p.triangle, vPosition, n, p.toEye);
    }
    return reflectedInLobe(p, seen, reflectanceOfSurroundings(p.byLamps, p.wo), p.byLamps.f0, n, p.s.roughness,
                           lobeAxis(n, p.toEye, p.byLamps));
  }
  vec3 reflectance = reflectanceOfSurroundings(p.s, p.wo);
  return isAnisotropic(p.s) ? reflectedStretched(p, seen, reflectance)
                            : reflectedInLobe(p, seen, reflectance, p.s.f0, n, p.s.roughness, lobeAxis(n, p.toEye, p.s));
}

// Metal, layer and coat.
vec3 reflectedAround(Place p, Visibility seen) {
  if (!hasGloss && !hasLayer && reflectionRule != reflectionThroughTransfer) return vec3(0.0);
  vec3 sum = p.left * reflectedByFacets(p, seen);
  if (hasTopLayers)
    sum += reflectedInLobe(p, seen, vec3(p.coated), vec3(p.top.coat * coatF0), p.top.coatNormal, p.top.coatRoughness,
                           lobeAxis(p.top.coatNormal, p.toEye, p.top.coatRoughness, coatF0, 1.0, 0.0));
  return sum;
}

// The sky through a body of glass, which is taken for a ball as thick as the material says: light is refracted where it enters and
// where it leaves.
vec3 skyThroughBall(Place p, Visibility seen, float ior, out float known) {
  vec3 n = p.n.reflecting, way = refract(-p.toEye, n, 1.0 / ior);
  float within = max(-dot(way, n), 0.0);
  vec3 beyond = refract(way, -(n + 2.0 * within * way), ior);
  return exp(-absorption * (thickness * within)) * radianceBehind(seen, beyond, p.s.roughness, known);
}

vec3 skyThroughBody(Place p, Visibility seen, out float known) {
  if (!hasDispersion || dispersion <= 0.0) return skyThroughBall(p, seen, glassIor, known);
  vec3 sum = vec3(0.0);
  for (int k = 0; k < waves; ++k) {
    float part = (float(k) + 0.5) / float(waves);
    sum += colorOfWave(part) * skyThroughBall(p, seen, iorOfWave(glassIor, dispersion, part), known);
  }
  return sum / float(waves);
}

// Returns the light that glass reflects and that comes through rough glass or glass with an inside. behind: factor of the picture behind it, which
// shows straight through the rest.
vec3 shadeGlass(Place p, Visibility seen, out vec3 behind) {
  vec3 reflected = facetOfGlass(p.s, p.nv);
  LobeAxis axis = lobeAxis(p.n.reflecting, p.toEye, p.s.roughness, meanOf(p.s.glassF0), p.s.glassF90, 0.0);
  vec3 radiance = reflectedInLobe(p, seen, reflected, p.s.glassF0, p.n.reflecting, p.s.roughness, axis);
  vec3 passed = (1.0 - largest(reflected)) * p.s.tint;
  bool hasInside = solidGlass != 0 && glassIor > 0.0;
  float known = 0.0;
  if (hasInside) {
    passed *= p.s.tint;  // where it leaves, too
    radiance += passed * skyThroughBody(p, seen, known);
  } else if (isRoughGlass(p.s)) {
    radiance += passed * radianceBehind(seen, -p.toEye, p.s.roughness, known);
  }
  behind = p.left * p.s.glass * (1.0 - known) * passed;
  return p.left * p.s.glass * radiance;
}
