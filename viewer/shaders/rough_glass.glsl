// Light through rough glass, as kernels/transport/rough_glass_funcs.cl has it: by a few of the microfacets that the eye sees, each
// of which looks up what its way leads to as blurred as the solid angle that it stands for ([1]). Needs scattering.glsl,
// surroundings.glsl and shadows.glsl.
// [1] Krivanek and Colbert 2008, "Real-time Shading with Filtered Importance Sampling".
// [2] Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
// [3] Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces".
const int facets = 16;
const float leastLobe = 1e-4;  // of what a lamp's light is worth in a direction, 1/sr: less is not looked at

bool isRoughGlass(Scattering s) { return hasRoughGlass && s.glass > 0.0 && s.roughness >= smoothBelow; }

// Thin glass lets narrow lobes through as if it were smooth: environment maps are no sharper than lobes of the greater roughness.
float shareBlurred(float roughness) {
  return hasRoughGlass && cube >= 0 ? smoothstep(smoothBelow, 0.1, roughness) : 0.0;
}

float smithMasking(float cosine, float a2) { return 2.0 * cosine / (cosine + sqrt(a2 + (1.0 - a2) * cosine * cosine)); }  // [3] eq. 34

float facetDensity(float nh, float a2) {  // [3] eq. 33
  float d = nh * nh * (a2 - 1.0) + 1.0;
  return a2 / (pi * d * d);
}

// What glass of the material reflects at a facet, of one surface or of both faces of a sheet.
vec3 facetOfGlass(Scattering s, float cosine) {
  vec3 reflected = glassReflectance(s, max(cosine, 1e-6));
  return solidGlass == 0 ? 2.0 * reflected / (1.0 + reflected) : reflected;
}

// Axes of the plane of a normal that turn with it slowly, and with the picture.
mat3 frameOf(vec3 n) {
  vec3 across = pixelRight.xyz - dot(pixelRight.xyz, n) * n;
  if (dot(across, across) < 1e-6 * dot(pixelRight.xyz, pixelRight.xyz)) across = pixelUp.xyz - dot(pixelUp.xyz, n) * n;
  across = normalize(across);
  return mat3(across, cross(n, across), n);
}

// Normal that is visible from wo, [2]; both in the frame of the surface.
vec3 visibleFacet(vec2 u, vec3 wo, float alpha) {
  vec3 v = normalize(vec3(alpha * wo.xy, wo.z));
  float z = (1.0 - u.y) * (1.0 + v.z) - v.z;
  float radius = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
  vec3 h = vec3(radius * cos(2.0 * pi * u.x), radius * sin(2.0 * pi * u.x), z) + v;
  return normalize(vec3(alpha * h.xy, max(h.z, 1e-6)));
}

// Points of four numbers that lie evenly: of a facet where light enters, and of one where it leaves.
vec4 pointOf(int k) { return fract(0.5 + float(k + 1) * vec4(0.85667488, 0.73389185, 0.62870672, 0.53859725)); }

// Solid angle of normals about h that one facet of all stands for.
float spanOf(vec3 wo, vec3 h, float a2) {
  return wo.z / (float(facets) * facetDensity(h.z, a2) * smithMasking(wo.z, a2) * max(dot(wo, h), 1e-4));
}

// Of a lamp's light that leaves a body where its outward normal is n: the share that goes along `way`'s refraction, for each
// unit of its irradiance; from: unit, from there back into the body.
float leavingLobe(vec3 n, vec3 from, vec3 toLight, float ior, float a2) {
  float eta = 1.0 / ior;
  float leaves = dot(n, toLight), comes = -dot(n, from);
  vec3 sum = from + eta * toLight;
  if (leaves <= 0.0 || comes <= 0.0 || dot(sum, sum) < 1e-12) return 0.0;
  vec3 h = normalize(sum);
  if (dot(h, n) > 0.0) h = -h;
  float inside = dot(from, h), outside = dot(toLight, h), both = inside + eta * outside;
  if (inside <= 0.0 || outside >= 0.0 || abs(both) < 1e-6) return 0.0;
  float density = facetDensity(-dot(h, n), a2) * smithMasking(comes, a2) * inside / comes * eta * eta * -outside / (both * both);
  return density * smithMasking(leaves, a2) * (1.0 - fresnelDielectric(inside, eta));
}

// Light of lamps that leaves a body at a point along -from.
vec3 lampsThroughBody(vec3 point, vec3 n, vec3 from, float ior, float a2) {
  vec3 sum = vec3(0.0);
  for (int k = 0; k < counts.y; ++k) {
    vec3 toLight;
    vec3 irradiance = perpendicularIrradiance(lights[k], point, toLight);
    float lobe = leavingLobe(n, from, toLight, ior, a2);
    if (lobe > leastLobe) sum += lobe * irradiance * visibility(k, point, n, 1);
  }
  return sum;
}

// Radiance that comes through a body from a refracted direction; solidAngle: of what the way stands for outside.
vec3 throughRoughBody(vec3 point, vec3 way, float ior, float alpha, vec2 u, float solidAngle) {
  if (cube < 0) return skyRadiance(way, levelOfSolidAngle(solidAngle));
  vec3 passed = vec3(1.0);
  for (int i = 0; i <= mostReflectionsWithin; ++i) {
    vec3 n = leaveBody(point, way, absorption, passed);
    if (dot(n, way) <= 0.0) break;
    mat3 frame = frameOf(n);
    vec3 h = frame * visibleFacet(u, way * frame, alpha);
    vec3 leaving = refract(way, -h, ior);
    if (dot(leaving, leaving) > 0.0 && dot(leaving, n) > 0.0)
      return passed * (surroundingWithin(point, leaving, solidAngle) + lampsThroughBody(point, n, -way, ior, alpha * alpha));
    way = reflect(way, dot(leaving, leaving) > 0.0 ? n : h);
  }
  return passed * surroundingWithin(point, way, solidAngle);
}

// What a facet of glass lets through on the way to the eye, and how wide: h, wo in the frame.
vec3 seenThroughFacet(mat3 frame, vec3 wo, vec3 h, float ior, float alpha, vec2 u, out float weight) {
  float a2 = alpha * alpha;
  float span = spanOf(wo, h, a2);
  float from = dot(wo, h);
  if (solidGlass == 0) {
    vec3 mirrored = 2.0 * from * h - wo;  // thin glass scatters what passes as a mirror image of what it reflects
    weight = smithMasking(max(mirrored.z, 0.0), a2);
    if (mirrored.z <= 0.0) return vec3(0.0);
    return surroundingWithin(vPosition, frame * vec3(mirrored.xy, -mirrored.z), 4.0 * from * span);
  }
  vec3 way = refract(-wo, h, 1.0 / ior);
  float to = dot(way, h);
  weight = smithMasking(max(-way.z, 0.0), a2);
  if (way.z >= 0.0) return vec3(0.0);
  float both = from + ior * to;
  float outside = both * both / max(-to, 1e-4);  // of a solid angle of normals, [3] eq. 17, once it has left the body
  return throughRoughBody(vPosition, frame * way, ior, alpha, u, 2.0 * outside * span);  // facets bend it at both ends
}

// Radiance that comes through glass of tint 1. reflected: what all its facets reflect of surroundings of one radiance.
vec3 seenThroughRoughGlass(Scattering s, vec3 n, vec3 toEye, out vec3 reflected) {
  float alpha = s.roughness * s.roughness;
  mat3 frame = frameOf(n);
  vec3 wo = toEye * frame;
  wo = normalize(vec3(wo.xy, max(wo.z, 1e-3)));
  vec3 sum = vec3(0.0), colors = vec3(0.0);
  float weights = 0.0;
  reflected = vec3(0.0);
  for (int k = 0; k < facets; ++k) {
    vec4 u = pointOf(k);
    vec3 h = visibleFacet(u.xy, wo, alpha);
    float ior = glassIor;
    vec3 color = vec3(1.0);
    if (hasDispersion && dispersion > 0.0) {
      float part = (float(k) + 0.5) / float(facets);
      ior = iorOfWave(glassIor, dispersion, part);
      color = colorOfWave(part);
    }
    float weight;
    vec3 seen = seenThroughFacet(frame, wo, h, ior, alpha, u.zw, weight);
    vec3 share = facetOfGlass(s, dot(wo, h));
    sum += weight * (1.0 - largest(share)) * color * seen;
    colors += color;
    reflected += weight * share;
    weights += weight;
  }
  reflected /= max(weights, 1e-6);
  return sum * float(facets) / (max(weights, 1e-6) * max(colors, vec3(1e-6)));
}

// Of a lamp's light, times the cosine: what rough glass reflects, and what passes a sheet from its other side.
vec3 roughGlassOfLight(Scattering s, vec3 n, vec3 toEye, vec3 toLight) {
  float nl = dot(n, toLight);
  bool passes = nl < 0.0;
  if (passes && solidGlass != 0) return vec3(0.0);
  vec3 mirrored = passes ? toLight - 2.0 * nl * n : toLight;
  vec3 h = normalize(toEye + mirrored);
  float a2 = s.roughness * s.roughness;
  a2 *= a2;
  vec3 share = facetOfGlass(s, dot(toEye, h));
  if (passes) share = (1.0 - largest(share)) * s.tint;
  return s.glass * share * microfacets(max(abs(nl), 1e-4), max(dot(n, toEye), 1e-4), max(dot(n, h), 0.0), a2) * abs(nl);
}
