// Photons leave their light. Options: PRELIGHT_PUNCTUAL, PRELIGHT_EMITTERS, PRELIGHT_SKY, as shade/light_funcs.cl.
#include "photon/path_funcs.cl"
#include "shade/scene_funcs.cl"

typedef struct Emission {
  float3 origin;
  float3 direction;  // unit
  float3 power;      // W, of the source as if it sent but this photon
  uint triangle;     // it leaves, or PRELIGHT_NO_TRIANGLE
} Emission;

// Point of the square of directions: the plain sequence, so that photons whose numbers agree modulo a power of two start
// in much the same direction; or the sequence within each of the cells in turn.
uint2 directionBits(PhotonSource s, __global const uint* cells, uint photon) {
  if (s.cellCount == 0u) return sampleSobolBits(photon, s.seed);
  const uint cell = cells[s.firstCell + photon % s.cellCount];
  const uint2 within = sampleSobolBits(photon / s.cellCount, s.seed ^ hashInteger(cell));
  const uint size = (uint)(0x100000000ul / s.cellsASide);  // a power of two of them
  return (uint2)(cell % s.cellsASide, cell / s.cellsASide) * size + within / s.cellsASide;
}

// The host has chosen cells of directions in a frame of its own.
float3 around(PhotonSource s, float3 axis, float cosine, float turns) {
  float3 x, y;
  makeFrame(axis, &x, &y);
  if (s.cellCount != 0u) {
    x = vload3(0, s.tangent);
    y = cross(axis, x);
  }
  const float sine = sqrt(fmax(1.0f - cosine * cosine, 0.0f));
  return normalize(sine * cospi(2.0f * turns) * x + sine * sinpi(2.0f * turns) * y + cosine * axis);
}

// Light from afar: a disc that covers what there is to meet.
void startAfar(__constant const PhotonParameters* p, float3 direction, float2 u, Emission* e) {
  float3 x, y;
  makeFrame(direction, &x, &y);
  const float radius = p->radius * sqrt(u.x);
  e->origin = vload3(0, p->centre) + radius * (cospi(2.0f * u.y) * x + sinpi(2.0f * u.y) * y) - p->distance * direction;
  e->direction = direction;
  e->power *= M_PI_F * p->radius * p->radius;
  e->triangle = PRELIGHT_NO_TRIANGLE;
}

#ifdef PRELIGHT_PUNCTUAL
Emission emitFromPunctual(__constant const PhotonParameters* p, __global const PunctualLight* light, float2 u) {
  Emission e;
  e.power = vload3(0, light->intensity);
  if (light->kind == PRELIGHT_DIRECTIONAL_LIGHT) {
    startAfar(p, vload3(0, light->direction), u, &e);
    return e;
  }
  e.origin = vload3(0, light->position);
  e.triangle = PRELIGHT_NO_TRIANGLE;
  // Larsen 6.3 with the polar angle acos(1 - 2 r); of a spot, over its cone.
  const float least = light->kind == PRELIGHT_SPOT_LIGHT ? clamp(-light->coneOffset / light->coneScale, -1.0f, 1.0f) : -1.0f;
  const float cosine = 1.0f - (1.0f - least) * u.y;
  e.direction = around(p->source, vload3(0, light->direction), cosine, u.x);
  e.power *= 2.0f * M_PI_F * (1.0f - least);
  if (light->kind == PRELIGHT_SPOT_LIGHT) {
    const float angular = clamp(cosine * light->coneScale + light->coneOffset, 0.0f, 1.0f);
    e.power *= angular * angular;
  }
  return e;
}
#endif

#ifdef PRELIGHT_EMITTERS
// choice.y decides about the side of an emitter that has two.
Emission emitFromSurface(__constant const PhotonParameters* p, Lights l, PathScene s, uint2 choice, float2 u, float2 place) {
  float probability = 1.0f, remainder;
  uint entry = p->source.light;
  if (entry == PRELIGHT_ALL_EMITTERS)
    entry = chooseEntry(l.tables + p->scene.lights.emitterTable, p->scene.lights.emitterCount, choice.x, &probability, &remainder);
  const uint triangle = l.emitters[entry];
  const DeviceTriangle t = s.surface.triangles[triangle];
  const float root = sqrt(place.x);
  const float b = root * (1.0f - place.y), c = root * place.y;
  const float3 q0 = vertexPosition(s, t.vertex[0]), q1 = vertexPosition(s, t.vertex[1]), q2 = vertexPosition(s, t.vertex[2]);
  const bool twoSided = (s.materials[t.material].flags & PRELIGHT_DOUBLE_SIDED) != 0u;
  const bool front = !twoSided || choice.y < 0x80000000u;
  const float3 normal = frontNormal(q0, q1, q2) * (front ? 1.0f : -1.0f);
  const float area = 0.5f * length(cross(q1 - q0, q2 - q0));
  Emission e;
  e.direction = around(p->source, normal, sqrt(1.0f - u.y), u.x);  // density cos/pi
  e.origin = offsetOrigin(pointOnTriangle(q0, q1, q2, b, c), pointError(q0, q1, q2, b, c), normal, e.direction);
  e.triangle = triangle;
  e.power = emittedRadiance(s, triangle, b, c, front) * (M_PI_F * area * (twoSided ? 2.0f : 1.0f) / probability);
  return e;
}
#endif

#ifdef PRELIGHT_SKY
Emission emitFromSky(__constant const PhotonParameters* p, Lights l, uint2 bits, float2 place) {
  Arrival a;
  arriveFromSky(l, &p->scene.lights, bits, &a);
  Emission e;
  e.power = a.radiance / a.density;
  startAfar(p, -a.direction, place, &e);
  return e;
}
#endif

// A photon a work-item: one after the other or, of a choice, those that `numbers` has from firstPhoton on. cells
// [source.firstCell + cell] -> paths, queue, rays [pathCount]; emitted [pathCount][3], in counts of the tallies. Next: trace,
// scatterPhotons.
__kernel void emitPhotons(__constant const PhotonParameters* p, __global const SurfaceLine* surface,
                          __global const ShadingLine* shading, __global const LightLine* lights,
                          __global const uint* cells, __global const uint* numbers, __global PhotonPath* paths,
                          __global uint* queue, __global Ray* rays, __global long* emitted) {
  const size_t i = get_global_id(0);
  if (i >= p->pathCount) return;
  const Scene scene = sceneOf(&p->scene, surface, shading, lights);
  const uint rank = p->firstPhoton + (uint)i;
  const uint photon = p->chosen != 0u ? numbers[rank] : rank;
  const uint2 bits = directionBits(p->source, cells, photon);
  const float2 u = (float2)(unitFloat(bits.x), unitFloat(bits.y));
  const float2 place = photonPoint(p, photon, PRELIGHT_PAIR_PLACE);
  Emission e;
#ifdef PRELIGHT_PUNCTUAL
  if (p->source.kind == PRELIGHT_SOURCE_PUNCTUAL) e = emitFromPunctual(p, scene.lights.punctual + p->source.light, u);
#endif
#ifdef PRELIGHT_EMITTERS
  if (p->source.kind == PRELIGHT_SOURCE_EMITTERS)
    e = emitFromSurface(p, scene.lights, scene.surface, photonBits(p, photon, PRELIGHT_PAIR_EMITTER), u, place);
#endif
#ifdef PRELIGHT_SKY
  if (p->source.kind == PRELIGHT_SOURCE_SKY) e = emitFromSky(p, scene.lights, bits, place);
#endif
  const PhotonSource source = p->source;
  float share = 1.0f / (float)source.count;
  if (source.cellCount != 0u) share *= (float)source.cellCount / ((float)source.cellsASide * (float)source.cellsASide);
  PhotonPath path;
  vstore3(e.power * share, 0, path.power);
  path.medium = PRELIGHT_NO_MEDIUM;
  path.scattered = 0u;
  path.photon = photon;
  path.mirrored = 0u;
  paths[i] = path;
  queue[i] = (uint)i;
  Ray ray;
  vstore3(e.origin, 0, ray.origin);
  vstore3(e.direction, 0, ray.direction);
  ray.sourceTriangle = e.triangle;
  ray.tMax = MAXFLOAT;
  rays[i] = ray;
  for (uint c = 0; c < 3; ++c) emitted[3 * i + c] = countsOf(p, path.power[c]);
}
