// Integral of a density estimation kernel K(distance / r) over the surface of a region within distance r of a point.
// Photon power is divided by it, so that constant irradiance is reproduced exactly up to edges and corners.
//
// A ball meets a triangle's plane at distance h in a disc of radius sqrt(r2 - h2) around the foot of its centre. The
// integral over the disc's part in the triangle is a sum over the directed edges: with G(s) the integral of K u du from
// 0 to s, an edge adds the integral of G(its distance or the disc's radius, whichever is less) over the angle that it
// subtends at the foot. All terms have closed forms.
// PRELIGHT_DENSITY_KERNEL: 0 constant, 1 cone, 2 Epanechnikov.
#ifndef PRELIGHT_PHOTON_KERNEL_AREA_FUNCS_CL
#define PRELIGHT_PHOTON_KERNEL_AREA_FUNCS_CL

#include "core/angle_funcs.cl"
#include "photon/leaf_tree_funcs.cl"

#ifndef PRELIGHT_DENSITY_KERNEL
#define PRELIGHT_DENSITY_KERNEL 2
#endif

// Integral of the kernel over a whole disc, divided by pi r2.
#if PRELIGHT_DENSITY_KERNEL == 0
#define PRELIGHT_DISC_SHARE 1.0f
#elif PRELIGHT_DENSITY_KERNEL == 1
#define PRELIGHT_DISC_SHARE (1.0f / 3.0f)
#else
#define PRELIGHT_DISC_SHARE 0.5f
#endif

// The disc in which a ball of radius r meets a plane.
typedef struct KernelDisc {
  float3 normal;   // unit normal of the plane
  float r;         // radius of the ball, > 0
  float h;         // distance of the ball's centre from the plane, 0 .. r
  float squared;   // radius of the disc, squared
  float perAngle;  // G at the disc's edge
} KernelDisc;

KernelDisc makeKernelDisc(float3 normal, float r, float h) {
  KernelDisc disc;
  disc.normal = normal;
  disc.r = r;
  disc.h = h;
  disc.squared = fmax(r * r - h * h, 0.0f);
#if PRELIGHT_DENSITY_KERNEL == 0
  disc.perAngle = 0.5f * disc.squared;
#elif PRELIGHT_DENSITY_KERNEL == 1
  disc.perAngle = 0.5f * disc.squared - (r * r * r - h * h * h) / (3.0f * r);
#else
  disc.perAngle = 0.25f * disc.squared * (disc.squared / (r * r));
#endif
  return disc;
}

#if PRELIGHT_DENSITY_KERNEL == 1
// Returns the integral, over the angle at the foot, of (squared distance from the ball's centre)^(3/2) - h^3 along a
// line at distance d from the foot, from its nearest point to a point t beyond it.
float coneRay(float d, float t, float h) {
  const float q = sqrt(d * d + h * h), whole = sqrt(q * q + t * t);
  const float turn = q > 0.0f ? asinh(t / q) : 0.0f;
  const float line = d * (0.5f * (t * whole + q * q * turn) + h * h * turn);
  return line + h * h * h * (angleOf(h * t, d * whole) - angleOf(t, d));
}
#endif

// Returns the integral over the triangle between the foot and a part of an edge within the disc. twice: twice the
// triangle's area, with the edge's sign.
float insideDisc(const KernelDisc disc, float3 from, float3 to, float twice) {
#if PRELIGHT_DENSITY_KERNEL == 0
  return 0.5f * twice;
#elif PRELIGHT_DENSITY_KERNEL == 1
  const float3 way = to - from;
  const float length2 = dot(way, way);
  if (!(length2 > 0.0f)) return 0.0f;
  const float length = sqrt(length2), d = fabs(twice) / length;
  const float cone = coneRay(d, dot(to, way) / length, disc.h) - coneRay(d, dot(from, way) / length, disc.h);
  return 0.5f * twice - copysign(cone / (3.0f * disc.r), twice);
#else
  const float meanSquare = (dot(from, from) + dot(from, to) + dot(to, to)) * (1.0f / 6.0f);
  return 0.5f * twice * (disc.squared - meanSquare) / (disc.r * disc.r);
#endif
}

float beyondDisc(const KernelDisc disc, float3 from, float3 to) {
  return disc.perAngle * angleOf(dot(disc.normal, cross(from, to)), dot(from, to));
}

// Returns the part of the edge from a to b in the integral over a polygon; a and b are relative to the foot.
float edgeIntegral(const KernelDisc disc, float3 a, float3 b) {
  const float3 way = b - a;
  const float length2 = dot(way, way), along = dot(a, way);
  const float inner = along * along - length2 * (dot(a, a) - disc.squared);
  if (!(inner > 0.0f)) return beyondDisc(disc, a, b);
  const float root = sqrt(inner);
  const float first = fmax((-along - root) / length2, 0.0f), last = fmin((-along + root) / length2, 1.0f);
  if (!(first < last)) return beyondDisc(disc, a, b);
  const float3 from = a + first * way, to = a + last * way;
  float sum = insideDisc(disc, from, to, (last - first) * dot(disc.normal, cross(a, b)));
  if (first > 0.0f) sum += beyondDisc(disc, a, from);
  if (last < 1.0f) sum += beyondDisc(disc, to, b);
  return sum;
}

// Returns the integral over a triangle for the ball around p; 0 out of reach.
float triangleIntegral(__global const AreaTriangle* t, float3 p, float r) {
  const float3 normal = vload3(0, t->normal);
  const float3 a = vload3(0, t->corners) - p, b = vload3(1, t->corners) - p, c = vload3(2, t->corners) - p;
  const float height = dot(normal, a);
  if (fabs(height) >= r) return 0.0f;
  const float3 foot = height * normal;
  const KernelDisc disc = makeKernelDisc(normal, r, fabs(height));
  return edgeIntegral(disc, a - foot, b - foot) + edgeIntegral(disc, b - foot, c - foot) +
         edgeIntegral(disc, c - foot, a - foot);
}

// Returns true when the disc of radius r around p, a point of the triangle's plane, lies within the triangle.
bool holdsDisc(__global const AreaTriangle* t, float3 p, float r) {
  const float3 normal = vload3(0, t->normal);
  for (uint i = 0; i < 3; ++i) {
    const float3 a = vload3(i, t->corners), way = vload3((i + 1) % 3, t->corners) - a;
    const float3 inward = cross(normal, way);
    if (!(dot(inward, p - a) >= r * length(inward))) return false;
  }
  return true;
}

// Returns true when photons on a plane at `height` with normal `normal` count for a query on a triangle of normal n.
bool nearTangentPlane(__constant const DensityParameters* parameters, float3 n, float3 normal, float height, float r) {
  return dot(n, normal) >= parameters->leastCosine && fabs(height) <= parameters->flatness * r;
}

// Returns true when nearTangentPlane holds for all triangles of a node.
bool allNearTangentPlane(__constant const DensityParameters* parameters, __global const AreaNode* node, float3 p, float3 n,
                         float r) {
  const float3 axis = vload3(0, node->normal);
  const float cosine = dot(axis, n), sine = sqrt(fmax(1.0f - cosine * cosine, 0.0f));
  const float turn = sqrt(fmax(1.0f - node->spread * node->spread, 0.0f));
  if (node->spread <= 0.0f || cosine <= 0.0f || cosine * node->spread - sine * turn < parameters->leastCosine) return false;
  const float3 lower = vload3(0, node->lower), upper = vload3(0, node->upper);
  const float thickness = dot(0.5f * (upper - lower), fabs(axis));
  const float height = fabs(dot(axis, 0.5f * (lower + upper) - p)) + thickness;
  return height + r * sqrt(fmax(2.0f - 2.0f * node->spread, 0.0f)) <= parameters->flatness * r;
}

// Returns the integral over all triangles of a node that lies within the ball. Not available for the cone kernel.
float nodeIntegral(__global const AreaNode* node, float3 p, float r) {
#if PRELIGHT_DENSITY_KERNEL == 0
  return node->area;
#else
  const float3 d = vload3(0, node->centre) - p;
  return node->area - (node->moment + node->area * dot(d, d)) / (r * r);
#endif
}

// Returns the kernel-weighted area of the surface whose photons count for a query at p, on a triangle of normal n, m2.
float kernelArea(__constant const DensityParameters* parameters, const LeafTree tree, __global const AreaNode* nodes,
                 __global const AreaTriangle* triangles, bool planar, float3 p, float3 n, float r) {
  const uint leaves = 1u << tree.levels;
  float sum = 0.0f;
  uint node = 1u;
  do {
    __global const AreaNode* area = nodes + tree.firstNode + node - 1u;
    const float3 lower = vload3(0, area->lower), upper = vload3(0, area->upper);
    if (squaredDistanceToBox(p, lower, upper) < r * r) {
      const float3 far = fmax(upper - p, p - lower);
      if (PRELIGHT_DENSITY_KERNEL != 1 && dot(far, far) <= r * r &&
          (planar || allNearTangentPlane(parameters, area, p, n, r))) {
        sum += nodeIntegral(area, p, r);
      } else if (node < leaves) {
        node = 2u * node;
        continue;
      } else {
        __global const AreaTriangle* first = triangles + (tree.firstLeaf + node - leaves) * PRELIGHT_LEAF_TRIANGLES;
        for (uint i = 0; i < area->triangleCount; ++i) {
          const float3 normal = vload3(0, first[i].normal);
          if (planar || nearTangentPlane(parameters, n, normal, dot(normal, vload3(0, first[i].corners) - p), r))
            sum += triangleIntegral(first + i, p, r);
        }
      }
    }
    node = nodeAfter(node);
  } while (node > 1u);
  return sum;
}

#endif
