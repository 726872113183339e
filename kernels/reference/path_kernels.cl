// The reference path tracer, a wavefront: rays are traced elsewhere (bvh/trace_kernels.cl), these kernels do the rest.
//   generatePaths -> [trace -> collectRadiance -> sampleLights -> trace -> addArrivals -> scatterPaths] ... -> averageSamples
// queue [ray] tells which path a ray belongs to. The order within a queue is left to chance; nothing depends on it,
// because every path has random numbers and a state of its own.
// Options: those of the included files, PRELIGHT_DIFFUSE_BOUNCES (most a path may have; unset: any number),
// PRELIGHT_NO_GLOSSY_BOUNCES, PRELIGHT_ABSORPTION (some glass absorbs), PRELIGHT_CACHED_LIGHT (diffuse rays look for
// lights alone: cached_light_kernels.cl brings the rest).
#include "shade/glass_funcs.cl"
#include "reference/path_funcs.cl"

// A path a work-item. -> paths, queue, rays [pathCount].
__kernel void generatePaths(__constant const ReferenceParameters* p, __global PathState* paths, __global uint* queue,
                            __global Ray* rays) {
  const size_t i = get_global_id(0);
  if (i >= p->pathCount) return;
  const uint pixel = p->firstPixel + (uint)i / p->samplesPerPass;
  const float2 jitter = pathPoint(p, (uint)i, PRELIGHT_PAIR_PIXEL);
  const float x = 2.0f * ((float)(pixel % p->width) + jitter.x) / (float)p->width - 1.0f;
  const float y = 1.0f - 2.0f * ((float)(pixel / p->width) + jitter.y) / (float)p->height;
  const float3 forward = vload3(0, p->forward), across = x * vload3(0, p->right) + y * vload3(0, p->up);
  const bool perspective = p->perspective != 0u;
  const float3 way = perspective ? forward + across : forward;
  const float stretch = length(way);  // metres along the ray for one of depth
  Ray ray;
  vstore3(vload3(0, p->eye) + way * p->zNear + (perspective ? (float3)(0.0f) : across), 0, ray.origin);
  vstore3(way / stretch, 0, ray.direction);
  ray.sourceTriangle = PRELIGHT_NO_TRIANGLE;
  ray.tMax = p->zFar < MAXFLOAT ? (p->zFar - p->zNear) * stretch : MAXFLOAT;
  rays[i] = ray;
  queue[i] = (uint)i;
  PathState path = {{1.0f, 1.0f, 1.0f}, 0.0f, {0.0f, 0.0f, 0.0f}, 1.0f, PRELIGHT_NO_MEDIUM, 0u, {0u, 0u}};
  paths[i] = path;
}

// A ray a work-item. Adds what the surface or the sky sends along the ray and takes away what glass absorbs.
__kernel void collectRadiance(__constant const ReferenceParameters* p, const uint count, const uint depth,
                              __global const Ray* rays, __global const Hit* hits, __global const uint* queue,
                              __global PathState* paths, __global const DeviceTriangle* triangles,
                              __global const DeviceMaterial* bases, __global const float2* texCoords,
                              __global const float4* colors, __global const ushort4* texels,
                              __global const float* vertices, __global const uchar* flat,
                              __global const ShadeMaterial* materials, __global const DeviceMaterial* layers,
                              __global const ushort4* layerTexels, __global const uint* tables,
                              __global const uint* emitters, __global const float* emitterDensities,
                              __global const PunctualLight* punctual, __global const float4* sky) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, layers, layerTexels};
  const Lights lights = {tables, emitters, emitterDensities, punctual, sky};
  __global PathState* path = paths + queue[i];
  const Ray ray = rays[i];
  const Hit hit = hits[i];
  const float scattered = path->scatterDensity;
  float3 throughput = vload3(0, path->throughput);
  float3 radiance = (float3)(0.0f);
  float density = 0.0f;  // with which sampling lights would have drawn this direction
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) {
#ifdef PRELIGHT_SKY
    const float2 uv = skyCoordinates(&p->lights, vload3(0, ray.direction));
    radiance = skyRadiance(lights, &p->lights, uv);
    density = skyDensity(lights, &p->lights, uv) * entryProbability(tables, p->lights.groupCount, p->lights.groupCount - 1u);
#endif
  } else {
    const PathVertex vertex = loadVertex(s, ray, hit);
#ifdef PRELIGHT_ABSORPTION
    // A ray that arrives at the back of solid glass has come through it, also when it started inside.
    uint medium = path->medium;
    if (!vertex.front && (materials[vertex.material].flags & PRELIGHT_SOLID) != 0u) medium = vertex.material;
    if (medium != PRELIGHT_NO_MEDIUM) {
      throughput *= absorbed(s, medium, hit.t);
      vstore3(throughput, 0, path->throughput);
    }
#endif
#ifdef PRELIGHT_EMITTERS
    if (emitterDensities[hit.triangle] > 0.0f) {
      radiance = emittedRadiance(s, hit.triangle, hit.u, hit.v, vertex.front);
      density = emitterDensity(lights, hit.triangle, hit.t, dot(vertex.wo, vertex.geometric)) *
                entryProbability(tables, p->lights.groupCount, p->lights.emitterGroup);
    }
#endif
    if (depth == 0u && (materials[vertex.material].flags & PRELIGHT_UNLIT) != 0u)
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

// A ray a work-item. Light that could arrive directly where the ray ends. With `light` below groupCount that punctual
// light, else one by chance. -> shadowRays, items [counters[0]].
__kernel void sampleLights(__constant const ReferenceParameters* p, const uint count, const uint depth,
                           __global const Ray* rays, __global const Hit* hits, __global const uint* queue,
                           __global const PathState* paths, __global const DeviceTriangle* triangles,
                           __global const DeviceMaterial* bases, __global const float2* texCoords,
                           __global const float4* colors, __global const ushort4* texels,
                           __global const float* vertices, __global const uchar* flat,
                           __global const ShadeMaterial* materials, __global const DeviceMaterial* layers,
                           __global const ushort4* layerTexels, __global const uint* tables,
                           __global const uint* emitters, __global const float* emitterDensities,
                           __global const PunctualLight* punctual, __global const float4* sky, const uint light,
                           __global Ray* shadowRays, __global ShadowItem* items, __global uint* counters) {
  const size_t i = get_global_id(0);
  if (i >= count || hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, layers, layerTexels};
  const Lights lights = {tables, emitters, emitterDensities, punctual, sky};
  const PathVertex vertex = loadVertex(s, rays[i], hits[i]);
  const Bsdf bsdf = loadBsdf(s, vertex);
  if (largest(bsdf.diffuse) <= 0.0f && !isGlossy(bsdf)) return;
  const Frame frame = frameAround(vertex.shading);
  const float3 wo = toFrame(frame, vertex.wo);
  if (wo.z <= 0.0f) return;

  const PathState path = paths[queue[i]];
#ifdef PRELIGHT_CACHED_LIGHT
  if (path.diffuseBounces > 0u) return;
#endif
  const uint pair = depth * PRELIGHT_PAIRS_A_VERTEX;
  const uint2 choice = pathBits(p, queue[i], pair + PRELIGHT_PAIR_LIGHT);
  const uint2 place = pathBits(p, queue[i], pair + PRELIGHT_PAIR_PLACE);
  float probability = 1.0f, remainder;
  const bool given = light != PRELIGHT_NO_TRIANGLE;
  const uint group = given ? light : chooseEntry(tables, p->lights.groupCount, choice.x, &probability, &remainder);
  Arrival a;
  bool arrives = false;
  // The groups' order: punctual lights, then the emitters as one, then the sky.
#ifdef PRELIGHT_PUNCTUAL
  if (given || group < p->lights.emitterGroup) arrives = arriveFromPunctual(punctual + group, vertex.position, &a);
#endif
#ifdef PRELIGHT_EMITTERS
  if (!given && group == p->lights.emitterGroup)
    arrives = arriveFromEmitter(lights, &p->lights, s, vertex.position, choice.y, (float2)(unitFloat(place.x), unitFloat(place.y)), &a);
#endif
#ifdef PRELIGHT_SKY
#ifdef PRELIGHT_EMITTERS
  if (!given && group == p->lights.emitterGroup + 1u) arrives = arriveFromSky(lights, &p->lights, place, &a);
#else
  if (!given && group == p->lights.emitterGroup) arrives = arriveFromSky(lights, &p->lights, place, &a);
#endif
#endif
  if (!arrives) return;
  const float3 wi = toFrame(frame, a.direction);
  // Above the shading normal's plane and the triangle's: else light would leak through the surface.
  if (wi.z <= 0.0f || dot(a.direction, vertex.geometric) <= 0.0f) return;
  const Reflection f = evaluateBsdf(bsdf, wo, wi);
  float3 reflected = f.diffuse + f.glossy;
#ifndef PRELIGHT_LIGHTS_ONLY
  if (!a.punctual) {
#ifdef PRELIGHT_SCATTER_ONLY
    return;
#else
#ifdef PRELIGHT_DIFFUSE_BOUNCES
    const bool diffuseGoesOn = path.diffuseBounces < PRELIGHT_DIFFUSE_BOUNCES;
#else
    const bool diffuseGoesOn = true;
#endif
    // A lobe that no ray follows leaves all its light to this sample.
    const LobeChoice lobes = chooseLobes(bsdf, wo.z, diffuseGoesOn, true);
    const float weight = misWeight(a.density * probability, scatterDensity(bsdf, lobes, wo, wi));
    reflected = diffuseGoesOn ? reflected * weight : f.diffuse + f.glossy * weight;
#endif
  }
#endif
  float3 radiance = vload3(0, path.throughput) * reflected * a.radiance / (a.density * probability);
#ifdef PRELIGHT_ABSORPTION
  if (path.medium != PRELIGHT_NO_MEDIUM) radiance *= absorbed(s, path.medium, a.distance);
#endif
  if (largest(radiance) <= 0.0f) return;
  const uint slot = atomic_inc(counters);
  Ray shadow = rayFrom(vertex, a.direction, a.distance);
  if (a.surface) {
    // The light's own triangle, whose distance is subject to rounding, must not count as in the way.
    const float3 way = a.target - vload3(0, shadow.origin);
    const bool ahead = dot(way, a.direction) > 0.0f;  // else rounding has carried the origin beyond the light
    if (ahead) vstore3(way, 0, shadow.direction);
    shadow.tMax = ahead ? 0.99998f : 0.0f;
  }
  shadowRays[slot] = shadow;
  ShadowItem item;
  vstore3(radiance, 0, item.radiance);
  item.path = queue[i];
  items[slot] = item;
}

// A shadow ray a work-item; a path has at most one.
__kernel void addArrivals(const uint count, __global const Hit* hits, __global const ShadowItem* items,
                          __global PathState* paths) {
  const size_t i = get_global_id(0);
  if (i >= count || hits[i].triangle != PRELIGHT_NO_TRIANGLE) return;
  const ShadowItem item = items[i];
  __global PathState* path = paths + item.path;
  vstore3(vload3(0, path->radiance) + vload3(0, item.radiance), 0, path->radiance);
}

// A ray a work-item. Draws the direction in which the path goes on. -> nextRays, nextQueue [counters[1]].
__kernel void scatterPaths(__constant const ReferenceParameters* p, const uint count, const uint depth,
                           __global const Ray* rays, __global const Hit* hits, __global const uint* queue,
                           __global PathState* paths, __global const DeviceTriangle* triangles,
                           __global const DeviceMaterial* bases, __global const float2* texCoords,
                           __global const float4* colors, __global const ushort4* texels,
                           __global const float* vertices, __global const uchar* flat,
                           __global const ShadeMaterial* materials, __global const DeviceMaterial* layers,
                           __global const ushort4* layerTexels, __global Ray* nextRays, __global uint* nextQueue,
                           __global uint* counters) {
  const size_t i = get_global_id(0);
  if (i >= count || hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, layers, layerTexels};
  const PathVertex vertex = loadVertex(s, rays[i], hits[i]);
  const Bsdf bsdf = loadBsdf(s, vertex);
  const Frame frame = frameAround(vertex.shading);
  const float3 wo = toFrame(frame, vertex.wo);
  PathState path = paths[queue[i]];
#ifdef PRELIGHT_CACHED_LIGHT
  if (path.diffuseBounces > 0u) return;
#endif
  const uint pair = depth * PRELIGHT_PAIRS_A_VERTEX;
  const float2 chance = pathPoint(p, queue[i], pair + PRELIGHT_PAIR_LOBE);
#ifdef PRELIGHT_DIFFUSE_BOUNCES
  const bool diffuse = path.diffuseBounces < PRELIGHT_DIFFUSE_BOUNCES;
#else
  const bool diffuse = true;
#endif
#ifdef PRELIGHT_NO_GLOSSY_BOUNCES
  const bool glossy = false;
#else
  const bool glossy = true;
#endif
  const LobeChoice lobes = chooseLobes(bsdf, wo.z, diffuse, glossy);
  if (!(lobes.diffuse + lobes.specular + lobes.glass > 0.0f)) return;

  float3 direction, weight;
  float density = 0.0f;
  float relativeIor2 = 1.0f;
  uint medium = path.medium;
#ifdef PRELIGHT_GLASS
  if (chance.x >= lobes.diffuse + lobes.specular) {
    // What is left of the choice of the lobe decides between reflection and transmission.
    const float rest = clamp((chance.x - lobes.diffuse - lobes.specular) / lobes.glass, 0.0f, 0.99999994f);
    direction = leaveGlass(s, vertex, bsdf, wo.z, rest, &weight, &relativeIor2, &medium);
    weight *= bsdf.glass / lobes.glass;
  } else
#endif
  {
    const bool specular = chance.x >= lobes.diffuse;
#ifdef PRELIGHT_MIRROR
    if (specular && bsdf.smooth) {
      direction = fromFrame(frame, (float3)(-wo.x, -wo.y, wo.z));
      weight = (bsdf.metal + bsdf.layer * schlick(bsdf, wo.z)) / lobes.specular;
    } else
#endif
    {
      const float3 wi = sampleLobe(bsdf, specular, pathPoint(p, queue[i], pair + PRELIGHT_PAIR_DIRECTION), wo);
      if (wi.z <= 0.0f) return;
      direction = fromFrame(frame, wi);
      density = scatterDensity(bsdf, lobes, wo, wi);
      const Reflection f = evaluateBsdf(bsdf, wo, wi);
      weight = ((lobes.diffuse > 0.0f ? f.diffuse : (float3)(0.0f)) + (lobes.specular > 0.0f ? f.glossy : (float3)(0.0f))) / density;
      if (!specular) ++path.diffuseBounces;
    }
    if (dot(direction, vertex.geometric) <= 0.0f) return;
  }

  float3 throughput = vload3(0, path.throughput) * weight / relativeIor2;
  path.relativeIor2 *= relativeIor2;
  const float strength = largest(throughput) * path.relativeIor2;
  if (!(strength > 0.0f)) return;
  if (depth >= p->rouletteDepth) {
    // What has lost nothing goes on: the depth ends it.
    const float survival = fmin(strength, 1.0f);
    if (chance.y >= survival) return;
    throughput /= survival;
  }
  vstore3(throughput, 0, path.throughput);
  path.scatterDensity = density;
  path.medium = medium;
  paths[queue[i]] = path;
  const uint slot = atomic_inc(counters + 1);
  nextRays[slot] = rayFrom(vertex, normalize(direction), MAXFLOAT);
  nextQueue[slot] = queue[i];
}

// A pixel of the block a work-item. paths [pixel][samplesPerPass] -> means [pixel], w unused. Compensated (Neumaier).
__kernel void averageSamples(__constant const ReferenceParameters* p, __global const PathState* paths,
                             __global float4* means) {
#pragma OPENCL FP_CONTRACT OFF
  const size_t i = get_global_id(0);
  const uint n = p->samplesPerPass;
  if (i >= p->pathCount / n) return;
  float3 sum = (float3)(0.0f), lost = (float3)(0.0f);
  for (uint s = 0; s < n; ++s) {
    const float3 term = vload3(0, paths[i * n + s].radiance);
    const float3 next = sum + term;
    lost += select((term - next) + sum, (sum - next) + term, fabs(sum) >= fabs(term));
    sum = next;
  }
  means[i] = (float4)((sum + lost) / (float)n, 0.0f);
}
