// Occlusion by the elements of viewer/techniques/screen/disks/disk_tree.h and groups of them; needs pi. Accessibility is 1 - the sum of form
// factors: Bunnell, "Dynamic ambient occlusion and indirect lighting", 2005, with the triangles of near elements as in
// Hoberock and Jia, "High-quality ambient occlusion", 2007. Fronts of surfaces occlude; scene coordinates.
uniform samplerBuffer disks;  // [node][4]: centre, radius; areas x normals, area (of a two-sided element negative); of a
                              // group its sum of areas x normal x normal, of an element two edges, and in w weight; end (-1: an
                              // element)
uniform float opening;        // radius over distance of groups that are not taken apart
uniform float reach;          // m, beyond which nothing occludes

const float nearElement = 0.25;  // radius over distance of elements whose triangle is looked at
const float leastHeight = 1e-3;  // of a place above an element that may occlude it, over the element's radius

// The share of a ball of a radius that lies within reach.
float shareWithin(float far, float radius) { return clamp(0.5 + 0.5 * (reach - far) / max(radius, 1e-20), 0.0, 1.0); }

// The form factor of a disk that looks at the place, of an area as seen from there: exact on the normal, A / (pi r^2 + A). A
// disk that the horizon cuts keeps what is above.
float diskFormFactor(float area, float far, float height) {
  float radius = sqrt(area / pi);
  float above = clamp(height + radius, 0.0, 2.0 * radius);
  float seen = height > radius ? height : above * above / max(4.0 * radius, 1e-20);
  return area * seen / max(far * (pi * far * far + area), 1e-30);
}

// An edge between unit vectors: the angle between them along their normal.
vec3 edgeTerm(vec3 a, vec3 b) {
  vec3 normal = cross(a, b);
  float sine = length(normal);
  return sine > 1e-7 ? normal * (atan(sine, dot(a, b)) / sine) : vec3(0.0);
}

vec3 unitOf(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }

// Where the line from a, above the horizon, to b, below it, crosses it.
vec3 cutAt(vec3 a, float heightOfA, vec3 b, float heightOfB) {
  return mix(a, b, heightOfA / max(heightOfA - heightOfB, 1e-30));
}

// The exact form factor of a triangle, corners from the place, above the horizon: Lambert's sum over edges.
float triangleFormFactor(vec3 a, vec3 b, vec3 c, vec3 n) {
  vec3 heights = vec3(dot(a, n), dot(b, n), dot(c, n));
  bvec3 above = greaterThan(heights, vec3(0.0));
  if (!any(above)) return 0.0;
  vec3 last = c, beforeLast = c;
  if (!all(above)) {  // turned until the first corner is above and the last is not
    for (int turn = 0; turn < 2 && !(heights.x > 0.0 && heights.z <= 0.0); ++turn) {
      vec3 first = a;
      a = b, b = c, c = first;
      heights = heights.yzx;
    }
    last = cutAt(a, heights.x, c, heights.z);
    beforeLast = last;
    if (heights.y > 0.0)
      beforeLast = cutAt(b, heights.y, c, heights.z);
    else
      b = cutAt(a, heights.x, b, heights.y);
  }
  a = unitOf(a), b = unitOf(b), beforeLast = unitOf(beforeLast), last = unitOf(last);
  vec3 sum = edgeTerm(a, b) + edgeTerm(b, beforeLast) + edgeTerm(beforeLast, last) + edgeTerm(last, a);
  return abs(dot(sum, n)) / (2.0 * pi);
}

// Form factor of an element without its weight. `way`: from the place to its centre.
float elementFormFactor(vec3 n, vec3 way, float far, float radius, vec4 area, vec3 edge, vec3 otherEdge) {
  float size = abs(area.w);
  float toFront = -dot(area.xyz, way) / max(size, 1e-30);  // height of the place above the element
  if (area.w < 0.0) toFront = abs(toFront);
  if (toFront <= leastHeight * radius) return 0.0;
  if (radius < nearElement * far) return diskFormFactor(size * toFront / far, far, dot(way, n));
  vec3 corner = way - (edge + otherEdge) / 3.0;
  return triangleFormFactor(corner, corner + edge, corner + otherEdge, n);
}

// Form factor of a group by the area of its fronts as seen from the place, half of all that it has and half of what its normals have in
// common. The root is exact where all normals are alike, and 15 % high where they are everywhere.
float groupFormFactor(vec3 n, vec3 way, float far, vec4 area, vec3 diagonal, vec3 others) {
  vec3 d = way / far;
  float squares = dot(diagonal, d * d) + 2.0 * dot(others, vec3(d.x * d.y, d.x * d.z, d.y * d.z));
  float fronts = 0.5 * (sqrt(max(area.w * squares, 0.0)) - dot(area.xyz, d));
  return diskFormFactor(max(fronts, 0.0), far, dot(way, n));
}

// Returns the occlusion above a place: xyz: form factors x directions; w: their sum, which may be above 1.
vec4 blockedByDisks(vec3 place, vec3 n) {
  vec4 blocked = vec4(0.0);
  int count = textureSize(disks) / 4;
  for (int node = 0; node < count;) {
    vec4 ball = texelFetch(disks, 4 * node);
    vec4 second = texelFetch(disks, 4 * node + 3);
    vec3 way = ball.xyz - place;
    float far = max(length(way), 1e-20);
    bool isElement = second.w < 0.0;
    bool isOut = far - ball.w > reach || dot(way, n) < -ball.w;
    if (!isOut && !isElement && ball.w > opening * far) {
      ++node;
      continue;
    }
    if (!isOut) {
      vec4 area = texelFetch(disks, 4 * node + 1);
      vec4 first = texelFetch(disks, 4 * node + 2);
      float factor = isElement ? elementFormFactor(n, way, far, ball.w, area, first.xyz, second.xyz)
                               : groupFormFactor(n, way, far, area, first.xyz, second.xyz);
      blocked += first.w * shareWithin(far, ball.w) * factor * vec4(way / far, 1.0);
    }
    node = isElement ? node + 1 : int(second.w);
  }
  return blocked;
}
