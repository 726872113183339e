// Light through rough glass, as kernels/transport/rough_glass_funcs.cl has it: by a few of the microfacets that the eye sees, each
// of which looks up what its way leads to as blurred as the solid angle that it stands for ([1]). Needs glass_lobe.glsl,
// surroundings.glsl and shadows.glsl.
// [1] Krivanek and Colbert 2008, "Real-time Shading with Filtered Importance Sampling".
// [2] Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
// [3] Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces".
const int facets = 8;
const int mostInRoughBody = 6;  // reflections
const float leastLobe = 1e-4;  // of what a lamp's light is worth in a direction, 1/sr: less is not looked at

uniform int glassTable;  // where the table of what a body scatters begins in `albedos`

// Thin glass lets narrow lobes through as if it were smooth: environment maps are no sharper than lobes of the greater roughness.
float shareBlurred(float roughness) {
  return hasRoughGlass && cube >= 0 ? smoothstep(smoothBelow, 0.1, roughness) : 0.0;
}

float facetDensity(float nh, float alpha) {  // [3] eq. 33
  float a2 = alpha * alpha;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  return a2 / (pi * d * d);
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

// Where light enters and where it leaves facet k: numbers that lie evenly. The pixels that one of the picture is the mean of take
// turns with them, as with the samples of large lights.
void pointsOf(int k, out vec2 enters, out vec3 leaves) {
  ivec2 turn = ivec2(gl_FragCoord.xy) % counts.z;
  float point = float(k + 1 + facets * (turn.x + counts.z * turn.y));
  enters = fract(0.5 + point * vec2(0.75487767, 0.56984029));
  leaves = fract(0.5 + point * vec3(0.41421356, 0.73205081, 0.23606798));
}

// Solid angle of normals about h that one facet of all stands for.
float spanOf(vec3 wo, vec3 h, float alpha) {
  return wo.z / (float(facets) * facetDensity(h.z, alpha) * smithMasking(wo.z, alpha) * max(dot(wo, h), 1e-4));
}

// Share of a lamp's light that leaves a body along `way`'s refraction where its outward normal is n, for each
// unit of its irradiance; from: unit, from there back into the body.
float leavingLobe(vec3 n, vec3 from, vec3 toLight, float ior, float alpha) {
  float eta = 1.0 / ior;
  float leaves = dot(n, toLight), comes = -dot(n, from);
  vec3 sum = from + eta * toLight;
  if (leaves <= 0.0 || comes <= 0.0 || dot(sum, sum) < 1e-12) return 0.0;
  vec3 h = normalize(sum);
  if (dot(h, n) > 0.0) h = -h;
  float inside = dot(from, h), outside = dot(toLight, h), both = inside + eta * outside;
  if (inside <= 0.0 || outside >= 0.0 || abs(both) < 1e-6) return 0.0;
  float density = facetDensity(-dot(h, n), alpha) * smithMasking(comes, alpha) * inside / comes * eta * eta * -outside / (both * both);
  return density * smithMasking(leaves, alpha) * (1.0 - fresnelDielectric(inside, eta));
}

// What a body's facets scatter at the first bounce of light from within; what they lose is taken to leave like the rest.
float scatteredWithin(float cosine, float roughness) {
  return max(betweenAlbedos(albedos, glassTable, PRELIGHT_GLASS_COSINES, PRELIGHT_GLASS_ROUGHNESSES, cosine, roughness).y, 0.05);
}

// Light of lamps that leaves a body at a point along -from.
vec3 lampsThroughBody(vec3 point, vec3 n, vec3 from, float ior, float roughness) {
  vec3 sum = vec3(0.0);
  if (counts.y == 0) return sum;
  float alpha = roughness * roughness;
  vec3 lifted = point + 2.0 * texelOfCube() * distance(point, cubeCenter) * n;  // the surface is known no better
  for (int k = 0; k < counts.y; ++k) {
    vec3 toLight;
    vec3 irradiance = perpendicularIrradiance(lights[k], point, toLight);
    float lobe = leavingLobe(n, from, toLight, ior, alpha);
    if (lobe > leastLobe) sum += lobe * irradiance * visibility(k, lifted, n, 1);
  }
  return sum / scatteredWithin(-dot(n, from), roughness);
}

// Visible and not masked on the way out, of those that are visible.
float unmasked(float from, float to, float alpha) {
  float terms = smithTerm(from, alpha);
  return to <= 0.0 ? 0.0 : to * (from + terms) / (from * smithTerm(to, alpha) + to * terms);
}

// Radiance that comes through a body from a refracted direction; straight: the way through a body without a cube of its own;
// solidAngle: of what the way stands for outside. What
// facets mask on the way out is not taken off: few ways with weights as unlike as those would show one by one.
vec3 throughRoughBody(vec3 point, vec3 way, vec3 straight, float ior, float roughness, vec3 u, float solidAngle) {
  if (cube < 0 || isOwnCube == 0) return surroundingWithin(point, straight, solidAngle);
  vec3 passed = vec3(1.0), sum = vec3(0.0);
  for (int i = 0; i <= mostInRoughBody; ++i) {
    vec3 n = leaveBody(point, way, absorption, passed);
    float leaves = dot(n, way);
    if (leaves <= 0.0) break;
    sum += passed * lampsThroughBody(point, n, -way, ior, roughness);
    vec3 h = frameOf(n) * visibleFacet(u.xy, way * frameOf(n), roughness * roughness);
    float reflected = fresnelDielectric(max(dot(h, way), 1e-6), 1.0 / ior);
    bool reflects = u.z < reflected;
    vec3 next = reflects ? reflect(way, h) : refract(way, -h, ior);
    bool meetsMore = reflects == dot(n, next) > 0.0;
    way = meetsMore ? reflect(way, n) : next;
    u.z = reflects ? u.z / reflected : (u.z - reflected) / (1.0 - reflected);
    reflects = reflects || meetsMore;
    if (!reflects) break;
    u.xy = fract(u.xy + vec2(0.75487767, 0.56984029));
  }
  return sum + passed * surroundingWithin(point, way, solidAngle);
}

// What a facet h of a body lets through on the way to the eye; h, wo in the frame. weight: share that others do not mask.
vec3 seenThroughFacet(mat3 frame, vec3 wo, vec3 h, float ior, float roughness, vec3 u, out float weight) {
  vec3 way = refract(-wo, h, 1.0 / ior);
  float alpha = roughness * roughness;
  weight = way.z < 0.0 ? smithMasking(-way.z, alpha) : 0.0;
  if (weight <= 0.0) return vec3(0.0);
  float from = dot(wo, h), to = -dot(way, h), both = from - ior * to;
  // Solid angle outside for one of normals ([3], Eq. 17), once the light has left the body, which bends it at both ends.
  float outside = 2.0 * both * both / max(to, 1e-4);
  vec3 mirrored = 2.0 * from * h - wo;
  vec3 straight = vec3(mirrored.xy, -mirrored.z);
  return weight * throughRoughBody(vPosition, frame * way, frame * straight, ior, roughness, u, outside * spanOf(wo, h, alpha));
}

// Radiance that comes through a body of tint 1. reflected: what all its facets reflect of surroundings of one radiance.
vec3 seenThroughRoughBody(Scattering s, mat3 frame, vec3 wo, out vec3 reflected) {
  float alpha = s.roughness * s.roughness;
  vec3 sum = vec3(0.0), colors = vec3(0.0);
  float weights = 0.0;
  reflected = vec3(0.0);
  for (int k = 0; k < facets; ++k) {
    vec2 enters;
    vec3 leaves;
    pointsOf(k, enters, leaves);
    vec3 h = visibleFacet(enters, wo, alpha);
    float ior = glassIor;
    vec3 color = vec3(1.0);
    if (hasDispersion && dispersion > 0.0) {
      float part = (float(k) + 0.5) / float(facets);
      ior = iorOfWave(glassIor, dispersion, part);
      color = colorOfWave(part);
    }
    float weight;
    float mirrored = unmasked(wo.z, 2.0 * dot(wo, h) * h.z - wo.z, alpha);
    vec3 seen = seenThroughFacet(frame, wo, h, ior, s.roughness, leaves, weight);
    vec3 share = facetOfGlass(s, dot(wo, h));
    sum += (1.0 - largest(share)) * color * seen;
    colors += color;
    reflected += mirrored * share;
    weights += mix(weight, mirrored, largest(share));
  }
  reflected /= max(weights, 1e-6);
  return sum * float(facets) / (max(weights, 1e-6) * max(colors, vec3(1e-6)));
}

// Radiance that comes through a sheet of tint 1. reflected: as above.
vec3 seenThroughRoughSheet(Scattering s, mat3 frame, vec3 wo, out vec3 reflected) {
  float alpha = s.roughness * s.roughness;
  vec3 sum = vec3(0.0), all = vec3(0.0);
  float weights = 0.0, later = laterInGlass(wo.z, s.roughness);
  reflected = vec3(0.0);
  for (int k = 0; k < facets; ++k) {
    vec2 enters;
    vec3 leaves;
    pointsOf(k, enters, leaves);
    vec3 h = visibleFacet(enters, wo, alpha);
    vec3 way = 2.0 * dot(wo, h) * h - wo;  // of what passes a sheet, the mirror image
    float weight = unmasked(wo.z, way.z, alpha);
    vec3 share = facetOfGlass(s, dot(wo, h));
    float solidAngle = 4.0 * dot(wo, h) * spanOf(wo, h, alpha);
    if (weight > 0.0)
      sum += weight * (1.0 - largest(share)) * surroundingWithin(vPosition, frame * vec3(way.xy, -way.z), solidAngle);
    reflected += weight * share;
    weights += weight;
    if (later < 0.01) continue;
    float radius = sqrt(leaves.x), angle = 2.0 * pi * leaves.y, cosine = sqrt(1.0 - radius * radius);
    vec3 down = vec3(radius * cos(angle), radius * sin(angle), -cosine);
    all += surroundingWithin(vPosition, frame * down, pi / (float(facets) * max(cosine, 0.1)));
  }
  vec3 last = facetOfGlass(s, laterCosine);
  reflected = mix(reflected / max(weights, 1e-6), last, later);
  return mix(sum / max(weights, 1e-6), (1.0 - largest(last)) * all / float(facets), later < 0.01 ? 0.0 : later);
}

// Radiance that comes through glass of tint 1.
vec3 seenThroughRoughGlass(Scattering s, vec3 n, vec3 toEye, out vec3 reflected) {
  mat3 frame = frameOf(n);
  vec3 wo = toEye * frame;
  wo = normalize(vec3(wo.xy, max(wo.z, 1e-3)));
  return solidGlass == 0 ? seenThroughRoughSheet(s, frame, wo, reflected) : seenThroughRoughBody(s, frame, wo, reflected);
}
