// What a path does where it meets the surface: gather light, ask for light that may arrive, go on.
// Options: those of the included files, PRELIGHT_DIFFUSE_BOUNCES (most a path may have; unset: any number),
// PRELIGHT_NO_GLOSSY_BOUNCES, PRELIGHT_ABSORPTION (some glass absorbs).
#ifndef PRELIGHT_REFERENCE_PATH_POINT_FUNCS_CL
#define PRELIGHT_REFERENCE_PATH_POINT_FUNCS_CL

#include "shade/glass_funcs.cl"
#include "reference/path_funcs.cl"

typedef struct PathPoint {
  PathVertex vertex;
  Bsdf bsdf;
  Frame frame;  // around the shading normal
  float3 wo;    // back along the ray, in the frame
  uint path;    // whose it is
} PathPoint;

PathPoint pathPointAt(PathScene s, PathVertex vertex, uint path) {
  PathPoint at;
  at.vertex = vertex;
  at.bsdf = loadBsdf(s, vertex);
  at.frame = frameAround(vertex.shading);
  at.wo = toFrame(at.frame, vertex.wo);
  at.path = path;
  return at;
}

// Adds what the surface or the sky sends along a ray and takes away what glass absorbs. vertex: where the ray hits.
void collectAt(__constant const ReferenceParameters* p, uint depth, PathScene s, Lights lights, Ray ray, Hit hit,
               PathVertex vertex, PathState* path) {
  const float scattered = path->scatterDensity;
  float3 throughput = vload3(0, path->throughput);
  float3 radiance = (float3)(0.0f);
  float density = 0.0f;  // with which sampling lights would have drawn this direction
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) {
#ifdef PRELIGHT_SKY
    const float2 uv = skyCoordinates(&p->scene.lights, vload3(0, ray.direction));
    radiance = skyRadiance(lights, &p->scene.lights, uv);
    density = skyDensity(lights, &p->scene.lights, uv) * entryProbability(lights.tables, p->scene.lights.groupCount, p->scene.lights.groupCount - 1u);
#endif
  } else {
#ifdef PRELIGHT_ABSORPTION
    // A ray that arrives at the back of solid glass has come through it, also when it started inside.
    uint medium = path->medium;
    if (!vertex.front && (s.materials[vertex.material].flags & PRELIGHT_SOLID) != 0u) medium = vertex.material;
    if (medium != PRELIGHT_NO_MEDIUM) {
      throughput *= absorbed(s, medium, hit.t);
      vstore3(throughput, 0, path->throughput);
    }
#endif
#ifdef PRELIGHT_EMITTERS
    if (lights.emitterDensities[hit.triangle] > 0.0f) {
      radiance = emittedRadiance(s, hit.triangle, hit.u, hit.v, vertex.front);
      density = emitterDensity(lights, hit.triangle, hit.t, dot(vertex.wo, vertex.geometric)) *
                entryProbability(lights.tables, p->scene.lights.groupCount, p->scene.lights.emitterGroup);
    }
#endif
    if (depth == 0u && (s.materials[vertex.material].flags & PRELIGHT_UNLIT) != 0u)
      radiance = baseColor(s, hit.triangle, hit.u, hit.v);
  }
  float weight = 1.0f;
  if (scattered > 0.0f) {
#if defined(PRELIGHT_LIGHTS_ONLY)
    weight = 0.0f;
#elif !defined(PRELIGHT_SCATTER_ONLY)
    weight = misWeight(scattered, density);
#endif
  }
  vstore3(vload3(0, path->radiance) + weight * throughput * radiance, 0, path->radiance);
}

// Light that could arrive directly: with `light` below groupCount that punctual light, else one by chance. False: none.
bool sampleLightAt(__constant const ReferenceParameters* p, uint depth, PathScene s, Lights lights, PathPoint at,
                   PathState path, uint light, Ray* shadow, ShadowItem* item) {
  if (!isDiffuse(at.bsdf) && !isGlossy(at.bsdf)) return false;
  if (at.wo.z <= 0.0f) return false;

  const uint pair = depth * PRELIGHT_PAIRS_A_VERTEX;
  const uint2 choice = pathBits(p, at.path, pair + PRELIGHT_PAIR_LIGHT);
  const uint2 place = pathBits(p, at.path, pair + PRELIGHT_PAIR_PLACE);
  float probability = 1.0f, remainder;
  const bool given = light != PRELIGHT_NO_TRIANGLE;
  const uint group = given ? light : chooseEntry(lights.tables, p->scene.lights.groupCount, choice.x, &probability, &remainder);
  Arrival a;
  bool arrives = false;
  // The groups' order: punctual lights, then the emitters as one, then the sky.
#ifdef PRELIGHT_PUNCTUAL
  if (given || group < p->scene.lights.emitterGroup) arrives = arriveFromPunctual(lights.punctual + group, at.vertex.position, &a);
#endif
#ifdef PRELIGHT_EMITTERS
  if (!given && group == p->scene.lights.emitterGroup)
    arrives = arriveFromEmitter(lights, &p->scene.lights, s, at.vertex.position, choice.y, (float2)(unitFloat(place.x), unitFloat(place.y)), &a);
#endif
#ifdef PRELIGHT_SKY
#ifdef PRELIGHT_EMITTERS
  if (!given && group == p->scene.lights.emitterGroup + 1u) arrives = arriveFromSky(lights, &p->scene.lights, place, &a);
#else
  if (!given && group == p->scene.lights.emitterGroup) arrives = arriveFromSky(lights, &p->scene.lights, place, &a);
#endif
#endif
  if (!arrives) return false;
  const float3 wi = toFrame(at.frame, a.direction);
  if (!maySee(at.bsdf, wi.z, dot(a.direction, at.vertex.geometric))) return false;
  const Reflection f = evaluateBsdf(at.bsdf, at.wo, wi);
  float3 reflected = f.diffuse + f.glossy;
#ifndef PRELIGHT_LIGHTS_ONLY
  if (!a.punctual) {
#ifdef PRELIGHT_SCATTER_ONLY
    return false;
#else
#ifdef PRELIGHT_DIFFUSE_BOUNCES
    const bool diffuseGoesOn = path.diffuseBounces < PRELIGHT_DIFFUSE_BOUNCES;
#else
    const bool diffuseGoesOn = true;
#endif
    // A lobe that no ray follows leaves all its light to this sample.
    const LobeChoice lobes = chooseLobes(at.bsdf, at.wo.z, diffuseGoesOn, true);
    const float weight = misWeight(a.density * probability, scatterDensity(at.bsdf, lobes, at.wo, wi));
    reflected = diffuseGoesOn ? reflected * weight : f.diffuse + f.glossy * weight;
#endif
  }
#endif
  float3 radiance = vload3(0, path.throughput) * reflected * a.radiance / (a.density * probability);
#ifdef PRELIGHT_ABSORPTION
  if (path.medium != PRELIGHT_NO_MEDIUM) radiance *= absorbed(s, path.medium, a.distance);
#endif
  if (largest(radiance) <= 0.0f) return false;
  *shadow = rayFrom(at.vertex, a.direction, a.distance);
  if (a.surface) {
    // The light's own triangle, whose distance is subject to rounding, must not count as in the way.
    const float3 way = a.target - vload3(0, shadow->origin);
    const bool ahead = dot(way, a.direction) > 0.0f;  // else rounding has carried the origin beyond the light
    if (ahead) vstore3(way, 0, shadow->direction);
    shadow->tMax = ahead ? 0.99998f : 0.0f;
  }
  vstore3(radiance, 0, item->radiance);
  item->path = at.path;
  return true;
}

// Draws the direction in which a path goes on. False: it ends.
bool scatterAt(__constant const ReferenceParameters* p, uint depth, PathScene s, PathPoint at, PathState* path, Ray* next) {
#ifdef PRELIGHT_DIFFUSE_BOUNCES
  const bool diffuse = path->diffuseBounces < PRELIGHT_DIFFUSE_BOUNCES;
#else
  const bool diffuse = true;
#endif
#ifdef PRELIGHT_NO_GLOSSY_BOUNCES
  const bool glossy = false;
#else
  const bool glossy = true;
#endif
  const LobeChoice lobes = chooseLobes(at.bsdf, at.wo.z, diffuse, glossy);
  if (!(lobeSum(lobes) > 0.0f)) return false;
  const uint pair = depth * PRELIGHT_PAIRS_A_VERTEX;
  const float2 chance = pathPoint(p, at.path, pair + PRELIGHT_PAIR_LOBE);

  float3 direction, weight;
  float density = 0.0f;
  float relativeIor2 = 1.0f;
  uint medium = path->medium;
  float pick = chance.x;
  const bool through = picksTransmitted(lobes, &pick);
#ifdef PRELIGHT_GLASS
  if (pick >= lobes.diffuse + lobes.specular) {
    // What is left of the choice of the lobe decides between reflection and transmission.
    const float rest = clamp((pick - lobes.diffuse - lobes.specular) / lobes.glass, 0.0f, 0.99999994f);
    direction = leaveGlass(s, at.vertex, at.bsdf, at.wo.z, rest, &weight, &relativeIor2, &medium);
    weight *= at.bsdf.glass / lobes.glass;
  } else
#endif
  {
    const bool specular = pick >= lobes.diffuse;
    float3 wi;
#ifdef PRELIGHT_MIRROR
    if (specular && at.bsdf.smooth) {
      wi = (float3)(-at.wo.x, -at.wo.y, at.wo.z);
      weight = (at.bsdf.metal + at.bsdf.layer * schlick(at.bsdf, at.wo.z)) / lobes.specular;
    } else
#endif
    {
      wi = sampleLobe(at.bsdf, specular, pathPoint(p, at.path, pair + PRELIGHT_PAIR_DIRECTION), at.wo);
      if (wi.z <= 0.0f) return false;
      if (through) wi.z = -wi.z;
      density = scatterDensity(at.bsdf, lobes, at.wo, wi);
      const Reflection f = evaluateBsdf(at.bsdf, at.wo, wi);
      weight = ((through || lobes.diffuse > 0.0f ? f.diffuse : (float3)(0.0f)) + (lobes.specular > 0.0f ? f.glossy : (float3)(0.0f))) / density;
      if (!specular) ++path->diffuseBounces;
    }
    direction = fromFrame(at.frame, wi);
    if (!maySee(at.bsdf, wi.z, dot(direction, at.vertex.geometric))) return false;
  }

  float3 throughput = vload3(0, path->throughput) * weight / relativeIor2;
  path->relativeIor2 *= relativeIor2;
  const float strength = largest(throughput) * path->relativeIor2;
  if (!(strength > 0.0f)) return false;
  if (depth >= p->rouletteDepth) {
    // What has lost nothing goes on: the depth ends it.
    const float survival = fmin(strength, 1.0f);
    if (chance.y >= survival) return false;
    throughput /= survival;
  }
  vstore3(throughput, 0, path->throughput);
  path->scatterDensity = density;
  path->medium = medium;
  *next = rayFrom(at.vertex, normalize(direction), MAXFLOAT);
  return true;
}

#endif
