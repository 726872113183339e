// Slices through the direction to the eye and what of them the surfaces of a picture block: the cosine-weighted inner integral
// in closed form of [1], summed over what of a slice is blocked, which [2] keeps as bits. Of one layer all below a sample within
// the radius is blocked, as in [1]. Of two, samples of a surface are joined to pieces, each of which blocks from one end to the
// other as far as it lies within the radius; between the front and the back of a body all is blocked, and below it nothing.
// Needs frame.glsl, screen_space.glsl and screen_variant.glsl.
// [1] Jimenez et al., "Practical real-time strategies for accurate indirect occlusion", 2016.
// [2] Therrien et al., "Screen space indirect lighting with visibility bitmask", 2023.
uniform int slices;
uniform int steps;        // of each side of a slice
uniform float thickness;  // m, of what has no back
uniform sampler2D sent;   // radiance that the first layer sends, if it is gathered

const float leastRise = 2e-3;  // sine of the angle above the horizon that is told from it
const int sectors = 32;
const uint allSectors = 0xffffffffu;

// A slice: x along d, y to the eye; angles are from y, positive towards x.
struct Slice {
  vec3 d;
  vec3 v;
  vec2 n;        // the normal in the slice, unit
  float lean;    // its angle
  float weight;  // of the slice, cosine and closed form included
  float first;   // the closed form at the horizon of the negative side
  float range;   // from there to that of the positive side
  float dither;  // of sectors, 0 to 1
  float radius;  // m, what is farther blocks nothing
};

// The integral of cos(t - lean) |sin t| from 0 to an angle of sine and cosine `at` ([1]), negative below 0; n as in Slice.
float massTo(float angle, vec2 at, vec2 n) {
  float doubled = (1.0 - 2.0 * at.x * at.x) * n.y + 2.0 * at.x * at.y * n.x;  // cos(2 angle - lean)
  float mass = 0.25 * (n.y - doubled + 2.0 * angle * n.x);
  return at.x < 0.0 ? -mass : mass;
}

// Abramowitz and Stegun, "Handbook of Mathematical Functions", 1964, 4.4.45: within 7e-5.
float quickAcos(float x) {
  float a = abs(x);
  float angle = sqrt(max(1.0 - a, 0.0)) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 - 0.0187293 * a)));
  return x < 0.0 ? pi - angle : angle;
}

Slice sliceOf(vec3 n, vec3 v, vec3 d, float dither) {
  vec2 inSlice = vec2(dot(n, d), dot(n, v));
  float size = length(inSlice);
  vec2 unit = inSlice / max(size, tiny);
  float lean = atan(unit.x, unit.y);
  float first = massTo(lean - 0.5 * pi, vec2(-unit.y, unit.x), unit);
  float range = massTo(lean + 0.5 * pi, vec2(unit.y, -unit.x), unit) - first;
  return Slice(d, v, unit, lean, size * range, first, range, dither, screen.z);
}

// The share of the slice's open half that lies on the negative side of a place.
float shareTo(Slice s, vec2 place) {
  vec2 at = place * inversesqrt(max(dot(place, place), 1e-30));
  if (dot(at, s.n) <= leastRise) return at.x > 0.0 ? 1.0 : 0.0;
  float angle = quickAcos(at.y);
  return clamp((massTo(at.x < 0.0 ? -angle : angle, at, s.n) - s.first) / s.range, 0.0, 1.0);
}

uint sectorsBetween(Slice s, float from, float to) {
  int first = int(from * float(sectors) + s.dither);
  int count = int(to * float(sectors) + s.dither) - first;
  return count <= 0 ? 0u : (allSectors >> uint(sectors - count)) << uint(first);
}

vec2 inSlice(Slice s, vec3 way) { return vec2(dot(way, s.d), dot(way, s.v)); }

// Returns the sectors that a straight piece between two places of the slice blocks within the radius.
uint blockedBy(Slice s, vec2 a, vec2 b) {
  vec2 way = b - a;
  float length2 = max(dot(way, way), tiny * s.radius * s.radius);
  float middle = -dot(a, way) / length2;
  float root2 = middle * middle - (dot(a, a) - s.radius * s.radius) / length2;
  float root = sqrt(max(root2, 0.0));
  float from = max(middle - root, 0.0);
  float to = min(middle + root, 1.0);
  if (root2 <= 0.0 || from >= to) return 0u;
  float first = shareTo(s, a + from * way);
  float second = shareTo(s, a + to * way);
  return sectorsBetween(s, min(first, second), max(first, second));
}

// A surface on a side of a slice.
struct Point {
  Seen seen;
  vec2 place;   // in the slice, from the pixel's
  float until;  // depth of the back of its body
};

const float endless = 1e30;

// Whether two points are of one surface: smooth, or both below the other's plane (an edge) or both above it (a corner). An
// outline is above the plane of what lies behind it, too, but its body ends before that.
bool areJoined(Point a, Point b) {
  vec3 way = normalize(b.seen.place - a.seen.place);
  float fromA = dot(a.seen.normal, way);
  float fromB = -dot(b.seen.normal, way);
  if (max(abs(fromA), abs(fromB)) < 0.3 || max(fromA, fromB) < 0.05) return true;
  bool nearA = a.seen.place.z < b.seen.place.z;
  bool isOutline = (nearA ? fromA : fromB) < 0.2 && (nearA ? a.until < b.seen.place.z : b.until < a.seen.place.z);
  return min(fromA, fromB) > -0.05 && !isOutline;
}

// Points that the last steps of a side have seen in a layer.
struct Chain {
  Point last;
  Point before;  // the last something nearer
};

uint follow(Slice s, Point now, inout Chain chain) {
  if (!now.seen.there) return 0u;
  bool fromLast = chain.last.seen.there && areJoined(chain.last, now);
  bool fromBefore = !fromLast && chain.before.seen.there && areJoined(chain.before, now);
  vec2 start = fromLast ? chain.last.place : (fromBefore ? chain.before.place : now.place);
  if (!fromLast && chain.last.seen.there && now.seen.place.z < chain.last.seen.place.z) chain.before = chain.last;
  chain.last = now;
  return blockedBy(s, start, now.place);
}

Point pointOf(Slice s, Seen seen, vec3 origin) { return Point(seen, inSlice(s, seen.place - origin), endless); }

// Adds the sectors of a step that looks at two layers.
uint blockedByLayers(Slice s, Line line, float along, vec3 origin, inout Point now, inout Chain behind) {
  Point next = pointOf(s, seenOn(secondLayer, line, along), origin);
  uint blocked = follow(s, next, behind);
  if (now.seen.there && next.seen.there && next.seen.back && !now.seen.back) {
    now.until = next.seen.place.z;
    blocked |= blockedBy(s, now.place, next.place);
  } else if (hasThickness && now.seen.there) {
    vec3 through = now.seen.place - thickness * toEyeFrom(now.seen.place);
    blocked |= blockedBy(s, now.place, inSlice(s, through - origin));
  }
  return blocked;
}

// Returns the light in newly blocked sectors from a visible surface that faces the place, in sectors times radiance.
vec3 sentThrough(uint fresh, Line line, float along, Seen from, vec3 origin) {
  if (!from.there || dot(from.normal, origin - from.place) <= 0.0) return vec3(0.0);
  return float(bitCount(fresh)) * texelFetch(sent, ivec2(floor(line.start + along * line.way)), 0).rgb;
}

// What is blocked on one side of a slice, `side` 1 or -1, by `count` steps, and what that sends, where it is gathered.
uint blockedSectors(Slice s, vec2 start, Seen here, float side, int count, float shift, inout vec3 received) {
  Line line = lineAlong(start, here.place, side * s.d);
  Point none = Point(nothing, vec2(0.0), endless);
  // From here to the first sample all is blocked from the horizon on.
  vec2 horizon = side * 1e-4 * screen.z * vec2(s.n.y, -s.n.x);
  Chain front = Chain(Point(here, horizon, endless), none);
  Chain behind = Chain(none, none);
  uint blocked = 0u;
  for (int j = 0; j < count; ++j) {
    float along = stepAlong(line, j, count, shift);
    if (along > line.length + 0.5) break;
    Point now = pointOf(s, seenOn(firstLayer, line, along), here.place);
    uint hidden = 0u, seen = 0u;
    if (layers == 1) {
      if (now.seen.there && length(now.place) < s.radius) seen = blockedBy(s, horizon, now.place);
    } else {
      hidden = blockedByLayers(s, line, along, here.place, now, behind);
      seen = follow(s, now, front);
    }
    if (gathers) received += sentThrough(seen & ~blocked, line, along, now.seen, here.place);
    blocked |= seen | hidden;
  }
  return blocked;
}

// Returns the sectors that are blocked on both sides.
uint blockedSectors(Slice s, vec2 start, Seen here, float shift, inout vec3 received) {
  return blockedSectors(s, start, here, 1.0, steps, shift, received) |
         blockedSectors(s, start, here, -1.0, steps, 1.0 - shift, received);
}

// Parts of a slice of equal angle.
const int parts = 8;

// Sines and cosines of the angles from the normal where they begin, and of their middles.
const vec2 partAngles[2 * parts + 1] = vec2[](
  vec2(-1.0000000, 0.0000000), vec2(-0.9807853, 0.1950903), vec2(-0.9238795, 0.3826834), vec2(-0.8314696, 0.5555702),
  vec2(-0.7071068, 0.7071068), vec2(-0.5555702, 0.8314696), vec2(-0.3826834, 0.9238795), vec2(-0.1950903, 0.9807853),
  vec2(0.0000000, 1.0000000), vec2(0.1950903, 0.9807853), vec2(0.3826834, 0.9238795), vec2(0.5555702, 0.8314696),
  vec2(0.7071068, 0.7071068), vec2(0.8314696, 0.5555702), vec2(0.9238795, 0.3826834), vec2(0.9807853, 0.1950903),
  vec2(1.0000000, 0.0000000));

// A place of the slice at an angle from the normal.
vec2 fromNormal(Slice s, vec2 angle) {
  return vec2(s.n.x * angle.y + s.n.y * angle.x, s.n.y * angle.y - s.n.x * angle.x);
}

// The share of the slice's open half before half part k.
float shareBefore(Slice s, int k) {
  float angle = s.lean + pi * (float(k) / float(2 * parts) - 0.5);
  return clamp((massTo(angle, fromNormal(s, partAngles[k]), s.n) - s.first) / s.range, 0.0, 1.0);
}

// Sectors that are of a part, and the direction of its middle.
uint partOf(Slice s, int i, out vec3 direction) {
  vec2 middle = fromNormal(s, partAngles[2 * i + 1]);
  direction = middle.x * s.d + middle.y * s.v;
  return sectorsBetween(s, shareBefore(s, 2 * i), shareBefore(s, 2 * i + 2));
}

// Slice i of a pixel, whose axes are perpendicular to the direction to the eye.
Slice sliceNumber(int i, Seen here, vec3 v, vec3 x, vec3 y, float turn) {
  float angle = pi * (float(i) + turn) / float(slices);
  return sliceOf(here.normal, v, cos(angle) * x + sin(angle) * y, fract(7.0 * turn + 0.618034 * float(i)));
}
