// Light of evenly bright, diffuse shapes in closed form; needs variant.glsl and `lampTables` of lights.glsl.
// [1] Lambert, "Photometria", 1760: of a polygon, half the sum over its edges of their angle times the normal of the plane through
//     edge and point. What the horizon cuts off is replaced by the horizon between where edges leave and come back.
// [2] The same of a circle r(a) = c + R (u cos a + v sin a): half the integral of (r x dr) / r^2, whose quotient of
//     trigonometric terms has a closed form. A ball looks like the disk that touches the cone of the directions to it.
// [3] Heitz et al., "Real-time polygonal-light shading with linearly transformed cosines", 2016.

struct AreaShape {
  int kind;       // ShapeKind
  int corners;
  int first;      // texel of the first corner of a polygon
  vec3 center;    // from the point that is lit
  vec3 axis;      // of a disk or polygon: towards its shining side
  vec3 u;         // of a disk: across its axis, as v = axis x u
  float radius;
  float facing;   // 1: the point is before it, -1: behind it, 0: where it does not shine to
};

const int shapeSphere = 0;
const int shapeDisk = 1;
const int shapePolygon = 2;
const int outlineCorners = 24;           // of a disk's mirror image
const float outlineScale = 1.00574110;  // sqrt(t / sin(t)) for a corner's angle t: the area of the disk

vec3 acrossAxis(vec3 axis) {
  vec3 other = abs(axis.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  return normalize(other - dot(other, axis) * axis);
}

// A shape at a light's entry of the tables as it is seen from a point; a ball as its disk.
AreaShape seenShape(vec3 position, vec3 direction, int entry, vec3 point) {
  vec4 head = FETCH(lampTables, entry);
  AreaShape s = AreaShape(int(head.x + 0.5), int(head.y + 0.5), entry + 1, position - point, direction, vec3(0.0), head.z, 0.0);
  if (s.kind == shapeSphere) {
    float distance2 = dot(s.center, s.center);
    float share = s.radius * s.radius / max(distance2, 1e-30);
    if (share >= 1.0) return s;  // within
    s.axis = -s.center * inversesqrt(distance2);
    s.center *= 1.0 - share;
    s.radius *= sqrt(1.0 - share);
    s.facing = 1.0;
  } else {
    float side = -dot(direction, s.center);
    s.facing = side > 0.0 ? 1.0 : head.w > 0.5 ? -1.0 : 0.0;
  }
  s.u = acrossAxis(s.axis);
  return s;
}

// The angle of (x, y); 0 where both are 0, where atan() is undefined.
float angleOf(float y, float x) { return y == 0.0 && x == 0.0 ? 0.0 : atan(y, x); }

int outlineOf(AreaShape s) { return s.kind == shapePolygon ? s.corners : outlineCorners; }

// Corner k of its outline from the point, counter-clockwise as seen from where it shines to.
vec3 outlineCorner(AreaShape s, int k) {
  if (s.kind == shapePolygon) return s.center + FETCH(lampTables, s.first + k).xyz;
  float turn = 2.0 * pi * float(k) / float(outlineCorners);
  return s.center + outlineScale * s.radius * (cos(turn) * s.u + sin(turn) * cross(s.axis, s.u));
}

// [1] of an edge.
vec3 edgeVector(vec3 a, vec3 b) {
  vec3 normal = cross(a, b);
  float sine = length(normal);
  return sine > 1e-20 ? normal * (atan(sine, dot(a, b)) / sine) : vec3(0.0);
}

// [1] of the outline, transformed, above the horizon of n: irradiance is the radiance times its part along n.
vec3 outlineVector(AreaShape s, mat3 transform, vec3 n) {
  int count = outlineOf(s);
  vec3 sum = vec3(0.0);
  vec3 horizon = vec3(0.0);  // where the first edge crosses it
  float turned = 0.0;        // about n, along the horizon
  vec3 a = transform * outlineCorner(s, count - 1);
  float heightA = dot(a, n);
  for (int k = 0; k < count; ++k) {
    vec3 b = transform * outlineCorner(s, k);
    float heightB = dot(b, n);
    if (heightA > 0.0 && heightB > 0.0) {
      sum += edgeVector(a, b);
    } else if (heightA > 0.0 || heightB > 0.0) {
      vec3 crossing = mix(a, b, heightA / (heightA - heightB));
      if (dot(horizon, horizon) == 0.0) horizon = crossing;
      float angle = angleOf(dot(cross(horizon, crossing), n), dot(horizon, crossing));
      turned += heightB > 0.0 ? angle : -angle;
      sum += heightA > 0.0 ? edgeVector(a, crossing) : edgeVector(crossing, b);
    }
    a = b;
    heightA = heightB;
  }
  return -0.5 * s.facing * (sum + turned * n);
}

float overItself(float arcTangentOf) {
  return abs(arcTangentOf) < 1e-2 ? 1.0 - arcTangentOf * arcTangentOf / 3.0 : atan(arcTangentOf) / arcTangentOf;
}

// log(1 + x) / x.
float logOver(float x) {
  return abs(x) < 1e-2 ? 1.0 - x * (0.5 - x * (1.0 / 3.0 - 0.25 * x)) : log(max(1.0 + x, 1e-30)) / x;
}

// Integrals of 1, cos a and sin a over D + E cos a from `from` to `to`; S^2 = D^2 - E^2.
vec3 circleIntegrals(float D, float E, float S, float from, float to) {
  float k = 1.0 / (D + S);
  float q = E * k;
  vec2 c = cos(vec2(from, to));
  vec2 t = sin(vec2(from, to)) / (1.0 + q * c);
  float rest = k * (t.y * overItself(q * t.y) - t.x * overItself(q * t.x));
  float span = to - from;
  float drop = (c.y - c.x) / (D + E * c.x);
  return vec3((span - 2.0 * E * rest) / S, (2.0 * D * rest - q * span) / S, -drop * logOver(E * drop));
}

// [2] of a disk above the horizon of n: what outlineVector is of a polygon.
vec3 diskVector(AreaShape s, vec3 n) {
  vec3 w = -s.facing * s.axis;
  float h = dot(s.center, w);
  vec3 beside = s.center - h * w;
  float p = length(beside);
  if (!(h > 0.0) || !(s.radius > 0.0)) return vec3(0.0);
  vec3 u = p > 1e-6 * s.radius ? beside / p : acrossAxis(w);
  vec3 v = cross(w, u);
  float R = s.radius;
  float D = h * h + p * p + R * R;
  float E = 2.0 * R * p;
  float S = max(sqrt((h * h + (p - R) * (p - R)) * (D + E)), 1e-6 * D);  // next to the rim
  float height = dot(s.center, n);
  vec2 rise = R * vec2(dot(u, n), dot(v, n));
  float highest = length(rise);
  if (height <= -highest) return vec3(0.0);
  float halfTurn = height >= highest ? pi : acos(clamp(-height / highest, -1.0, 1.0));
  float middle = highest > 0.0 ? angleOf(rise.y, rise.x) : 0.0;
  vec3 integrals = circleIntegrals(D, E, S, middle - halfTurn, middle + halfTurn);
  vec3 sum = integrals.x * R * R * w + R * (integrals.y * (p * w - h * u) - integrals.z * h * v);
  if (height < highest) {
    vec3 start = s.center + R * (cos(middle - halfTurn) * u + sin(middle - halfTurn) * v);
    vec3 end = s.center + R * (cos(middle + halfTurn) * u + sin(middle + halfTurn) * v);
    sum += angleOf(dot(cross(end, start), n), dot(end, start)) * n;
  }
  return 0.5 * sum;
}

vec3 shapeVector(AreaShape s, vec3 n) {
  if (s.facing == 0.0) return vec3(0.0);
  return s.kind == shapePolygon ? outlineVector(s, mat3(1.0), n) : diskVector(s, n);
}

// Share of a glossy lobe that a shape covers: the lobe is a cosine whose sides are stretched [3]. GGX along the normal is the cosine
// with sides alpha times as wide; about a mirrored direction angles double in the plane of incidence, and less across it. The
// numbers are a least-squares fit to the GGX lobe (docs/notes/shading.md#area-lights).
float lobeShare(AreaShape s, vec3 n, vec3 toEye, float alpha) {
  if (s.facing == 0.0) return 0.0;
  float nv = clamp(dot(n, toEye), 1e-3, 1.0);
  vec3 z = normalize(mix(2.0 * nv * n - toEye, n, min(2.3 * alpha * alpha, 1.0)));
  vec3 y = cross(n, z);
  float sine2 = dot(y, y);
  y = sine2 > 1e-8 ? y * inversesqrt(sine2) : acrossAxis(z);
  vec3 x = cross(y, z);
  float along = 1.92 * alpha / (1.0 + 0.85 * alpha * alpha);
  float across = 1.92 * alpha * pow(nv, 0.64) / (1.0 + 0.33 * alpha * alpha);
  mat3 toLobe = transpose(mat3(x / along, y / across, z));
  return clamp(outlineVector(s, toLobe, vec3(0.0, 0.0, 1.0)).z / pi, 0.0, 1.0);
}
