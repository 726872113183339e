// The surfaces of a picture and of what lies around it, as screen_surface.frag wrote them; needs frame.glsl. Camera space:
// x right, y up, z depth; metres from the eye.
uniform sampler2D firstLayer;   // nearest to the eye
uniform sampler2D secondLayer;  // behind it, fronts and backs
uniform vec4 screen;            // xy: size of the layers, pixels; z: radius, m; w: greatest reach, pixels
uniform ivec4 corner;           // xy: of this picture in the layers; zw: added to a pixel for its place in patterns
uniform int stride;             // pixels of the layers from one pixel of this picture to the next
uniform vec2 rotation;          // of patterns: added to turns and shifts

const float tiny = 1e-12;

struct Seen {
  bool there;
  bool back;
  vec3 place;
  vec3 normal;  // unit, on the side seen
};

const Seen nothing = Seen(false, false, vec3(0.0), vec3(0.0, 0.0, -1.0));

bool isPerspective() { return eye.w > 0.5; }

// Half the picture's size on the plane at unit depth; anywhere for orthographic pictures.
vec2 halfPicture() { return vec2(length(pixelRight.xyz), length(pixelUp.xyz)); }

vec3 placeOf(vec2 at, float depth) {
  vec2 place = ((2.0 * at / screen.xy - 1.0) * tile.xy + tile.zw) * halfPicture();
  return vec3(isPerspective() ? place * depth : place, depth);
}

vec2 pixelOf(vec3 place) {
  vec2 plane = isPerspective() ? place.xy / place.z : place.xy;
  return 0.5 * screen.xy * ((plane / halfPicture() - tile.zw) / tile.xy + 1.0);
}

vec3 toEyeFrom(vec3 place) { return isPerspective() ? -normalize(place) : vec3(0.0, 0.0, -1.0); }

Seen seenIn(sampler2D layer, ivec2 pixel) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(screen.xy)))) return nothing;
  vec4 surface = texelFetch(layer, pixel, 0);
  if (surface.w == 0.0) return nothing;
  return Seen(true, surface.w < 0.0, placeOf(vec2(pixel) + 0.5, abs(surface.w)), surface.xyz);
}

// 0 where the radius covers too few pixels of a surface for anything to be found within it, 1 where it covers enough.
float resolution(Seen here) {
  float pixel = 2.0 * halfPicture().y * tile.y / screen.y * (isPerspective() ? here.place.z : 1.0);
  return smoothstep(0.5, 2.0, screen.z / pixel * dot(here.normal, toEyeFrom(here.place)));
}

vec3 toScene(vec3 direction) {
  return normalize(pixelRight.xyz) * direction.x + normalize(pixelUp.xyz) * direction.y + forward.xyz * direction.z;
}

// Axes perpendicular to a unit direction.
void axesAround(vec3 v, out vec3 x, out vec3 y) {
  x = normalize(cross(abs(v.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), v));
  y = cross(v, x);
}

// Pixel of the layers that this fragment looks at, and its place in patterns.
ivec2 pixelHere() { return stride * ivec2(gl_FragCoord.xy) + corner.xy; }
ivec2 placeInPattern() { return ivec2(gl_FragCoord.xy) + corner.zw; }

// A pixel's place in a pattern of 4 x 4 that the filter averages: 16 turns and 4 shifts, 0 to 1, after Jimenez et al.,
// "Practical real-time strategies for accurate indirect occlusion", 2016.
float turnOf(ivec2 pixel) { return fract((float(((pixel.x + pixel.y) & 3) * 4 + (pixel.x & 3)) + 0.5) / 16.0 + rotation.x); }
float shiftOf(ivec2 pixel) { return fract((float((pixel.y - pixel.x) & 3) + 0.5) / 4.0 + rotation.y); }

// Pixels that a direction from a place covers within the radius: a line, as the eye lies in its plane.
struct Line {
  vec2 start;
  vec2 way;      // unit
  float length;  // pixels
};

// `d`: unit, perpendicular to the direction to the eye.
Line lineAlong(vec2 start, vec3 place, vec3 d) {
  vec2 toward = isPerspective() ? d.xy * place.z - place.xy * d.z : d.xy;
  vec2 way = toward / (halfPicture() * tile.xy) * screen.xy;
  vec3 end = place + d * screen.z;
  if (isPerspective()) {  // where the line of sight touches the sphere
    float sine = min(screen.z / length(place), 0.97);
    end = normalize(place) * sqrt(1.0 - sine * sine) + d * sine;
  }
  bool ends = !isPerspective() || end.z > 0.02;
  float reach = ends ? min(distance(pixelOf(end), start), screen.w) : screen.w;
  return Line(start, way / max(length(way), tiny), reach);
}

// Pixels from the line's start to step j of n: denser nearby, and never on a pixel twice.
float stepAlong(Line line, int j, int n, float shift) {
  float share = (float(j) + shift) / float(n);
  return max(line.length * share * share, float(j) + 1.0);
}

// Returns the surface of the pixel there, with its plane at that very point of the line, not in the pixel's middle, which lies
// beside the line.
Seen seenOn(sampler2D layer, Line line, float along) {
  vec2 at = line.start + along * line.way;
  Seen seen = seenIn(layer, ivec2(floor(at)));
  if (!seen.there) return seen;
  vec3 ray = isPerspective() ? placeOf(at, 1.0) : vec3(0.0, 0.0, 1.0);
  vec3 from = isPerspective() ? vec3(0.0) : placeOf(at, 0.0);
  float slope = dot(seen.normal, ray);
  float depth = dot(seen.normal, seen.place - from) / slope;
  bool isSure = slope < -0.005 * length(ray) && abs(depth - seen.place.z) < screen.z;
  if (isSure) seen.place = from + depth * ray;
  return seen;
}
