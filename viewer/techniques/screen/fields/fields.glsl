// Occlusion by the fields of objects of viewer/techniques/screen/fields/field_occlusion.h; needs pi. What an object hides around a place is the
// ball, or cone, of the same solid angle and mean direction [1], and what its three bands of SH differ from that cone's.
// [1] Kontkanen and Laine, "Ambient occlusion fields", 2005. [2] Howell, "A catalog of radiation configuration factors", B-43.
uniform samplerBuffer fieldPlaces;  // [object][4]: rows from scene coordinates to cells; cells along x, y, z, first one
uniform samplerBuffer fieldCells;   // [cell][3]: integrals of Y_0 to Y_8 over the directions that meet the object

// Bands 0 and 1, band 2 without its last, that.
struct Hidden {
  vec4 low;
  vec4 high;
  float last;
};

Hidden hiddenIn(int cell) {
  return Hidden(texelFetch(fieldCells, 3 * cell), texelFetch(fieldCells, 3 * cell + 1), texelFetch(fieldCells, 3 * cell + 2).x);
}

Hidden mixed(Hidden a, Hidden b, float t) {
  return Hidden(mix(a.low, b.low, t), mix(a.high, b.high, t), mix(a.last, b.last, t));
}

// `at`: in cells from the grid's lower corner; their values are those of their middles.
Hidden hiddenAt(vec3 at, ivec3 size, int first) {
  vec3 inner = clamp(at - 0.5, vec3(0.0), vec3(size) - 1.0);
  ivec3 lower = min(ivec3(inner), size - 2);
  vec3 t = inner - vec3(lower);
  int x = first + lower.x + size.x * (lower.y + size.y * lower.z), y = size.x, z = size.x * size.y;
  Hidden near = mixed(mixed(hiddenIn(x), hiddenIn(x + 1), t.x), mixed(hiddenIn(x + y), hiddenIn(x + y + 1), t.x), t.y);
  x += z;
  Hidden far = mixed(mixed(hiddenIn(x), hiddenIn(x + 1), t.x), mixed(hiddenIn(x + y), hiddenIn(x + y + 1), t.x), t.y);
  return mixed(near, far, t.z);
}

// The form factor of a cone of directions, above the horizon [2]; the cosine of half its angle, of its axis and the normal.
float narrowConeFormFactor(float halfAngle, float cosine) {
  float sine = sqrt(max(1.0 - halfAngle * halfAngle, 0.0));
  if (sine <= 1e-4 || cosine <= -sine) return 0.0;
  if (cosine >= sine) return sine * sine * cosine;
  float across = sqrt(max(1.0 - cosine * cosine, 1e-9));
  float rim = asin(clamp(halfAngle / across, -1.0, 1.0));
  float arc = acos(clamp(-halfAngle * cosine / (sine * across), -1.0, 1.0));
  float chord = halfAngle * sqrt(max(sine * sine - cosine * cosine, 0.0));
  return clamp(0.5 - rim / pi + (sine * sine * cosine * arc - chord) / pi, 0.0, 1.0);
}

// Returns the form factor of a cone; one wider than a half space is the complement of a narrower cone.
float coneFormFactor(float halfAngle, float cosine) {
  return halfAngle < 0.0 ? 1.0 - narrowConeFormFactor(-halfAngle, -cosine) : narrowConeFormFactor(halfAngle, cosine);
}

float bandTwo(Hidden h, vec3 n) {
  vec4 basis = vec4(1.0925484305920792 * n.x * n.y, 1.0925484305920792 * n.y * n.z, 0.31539156525252005 * (3.0 * n.z * n.z - 1.0),
                    1.0925484305920792 * n.z * n.x);
  return dot(h.high, basis) + 0.54627421529603959 * (n.x * n.x - n.y * n.y) * h.last;
}

float solidAngleOf(Hidden h) { return clamp(h.low.x * 3.5449077018110322, 0.0, 4.0 * pi); }  // over Y_0

// n: unit, in the shape's own coordinates. xyz: the direction of what is hidden; w: the share of an even sky.
vec4 hiddenAbove(Hidden h, vec3 n) {
  float solidAngle = solidAngleOf(h);
  if (solidAngle < 1e-4) return vec4(0.0);
  vec3 sum = h.low.wyz / 0.48860251190291992;  // of directions
  float length = max(length(sum), 1e-12);
  vec3 axis = sum / length;
  float halfAngle = 1.0 - solidAngle / (2.0 * pi), cosine = dot(n, axis), cut = 1.0 - halfAngle * halfAngle;
  float share = coneFormFactor(halfAngle, cosine);
  // The clamped cosine keeps 2/3 of band 1 and 1/4 of band 2.
  share += (length - pi * cut) * cosine / (2.0 * pi);
  share += 0.25 * (bandTwo(h, n) - 5.0 / 4.0 * halfAngle * cut * (1.5 * cosine * cosine - 0.5));
  return vec4(axis, clamp(share, 0.0, 1.0));
}

// How far above a place it is looked for, in cells: up to a half where much is hidden, as something is near, and cells behind
// the place see what receivers cannot.
float liftFor(float solidAngle) { return 0.5 * smoothstep(0.06, 0.2, solidAngle / (4.0 * pi)); }

// Occlusion by object `o` above a place; directions in scene coordinates.
vec4 hiddenByObject(int o, vec3 place, vec3 n) {
  vec4 counts = texelFetch(fieldPlaces, 4 * o + 3);
  vec4 x = texelFetch(fieldPlaces, 4 * o), y = texelFetch(fieldPlaces, 4 * o + 1), z = texelFetch(fieldPlaces, 4 * o + 2);
  vec3 at = vec3(dot(x.xyz, place) + x.w, dot(y.xyz, place) + y.w, dot(z.xyz, place) + z.w);
  if (counts.x < 1.0 || any(lessThan(at, vec3(0.0))) || any(greaterThan(at, counts.xyz))) return vec4(0.0);
  vec3 inShape = normalize(vec3(dot(x.xyz, n), dot(y.xyz, n), dot(z.xyz, n)));
  Hidden around = hiddenAt(at, ivec3(counts.xyz), int(counts.w));
  float lift = liftFor(solidAngleOf(around));
  if (lift > 0.0) around = hiddenAt(at + lift * inShape, ivec3(counts.xyz), int(counts.w));
  vec4 hidden = hiddenAbove(around, inShape);
  vec3 d = hidden.x * x.xyz + hidden.y * y.xyz + hidden.z * z.xyz;
  return vec4(d * inversesqrt(max(dot(d, d), 1e-30)), hidden.w);
}
