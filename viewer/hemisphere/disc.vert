#version 410 core
// A triangle in the discs of receivers (viewer/hemisphere/disc_pictures.h). An instance is a receiver. What is drawn is a
// right triangle around the rectangle around the disc's image of a cap around the spherical triangle; disc.frag tests
// directions.
uniform samplerBuffer corners;     // [triangle][3], scene coordinates
uniform usamplerBuffer receivers;  // [receiver][5], bits of floats: position, right, up, normal, geometric normal; the first w: own triangle
uniform usamplerBuffer holed;      // [triangle], 1 + index of its coverage, or 0 where it has no holes
uniform ivec4 tiles;               // x: texels a side of a picture, y: pictures along a row, z: the first receiver, w: texels a side of all
uniform int orthographic;          // 1; 0: stereographic

flat out vec3 side0, side1, side2;  // planes through the receiver and the side opposite a corner, positive inside
flat out vec3 tolerances;           // of the tests against these planes
flat out vec3 surface;              // plane of the triangle: direction to it over the distance
flat out vec3 ownNormal;              // geometric normal of a receiver whose own triangle this is, else 0
flat out ivec2 tile;                // first texel of the picture
flat out uint triangle;
flat out uint coverage;             // as in holed

const float rounding = 4e-7;
const float flatness = 1e-6;  // height of a receiver over a triangle's plane, of its distance, below which it lies in the plane

// Returns the rectangle (low, high) around the image of a cap.
vec4 rectangleOf(vec3 axis, float angle) {
  if (orthographic == 1) {
    vec2 at = acos(clamp(axis.xy, -1.0, 1.0));
    return vec4(cos(min(at + angle, 3.14159265)), cos(max(at - angle, 0.0)));
  }
  float slope = atan(length(axis.xy), axis.z);
  if (slope + angle > 3.0) return vec4(-1.0, -1.0, 1.0, 1.0);
  float near = tan(0.5 * (slope - angle)), far = tan(0.5 * (slope + angle));
  vec2 centre = 0.5 * (near + far) * (slope > 1e-6 ? normalize(axis.xy) : vec2(0.0));
  return vec4(centre - 0.5 * (far - near), centre + 0.5 * (far - near));
}

// Returns the rectangle in which a triangle lies; the whole picture where it fills more than a hemisphere's cap.
vec4 rectangleAround(vec3 a, vec3 b, vec3 c) {
  vec3 sum = a + b + c;
  if (dot(sum, sum) < 1e-2) return vec4(-1.0, -1.0, 1.0, 1.0);
  vec3 axis = normalize(sum);
  float chord = max(max(distance(axis, a), distance(axis, b)), distance(axis, c));
  if (chord > 1.4) return vec4(-1.0, -1.0, 1.0, 1.0);
  const vec4 margin = vec4(-1e-3, -1e-3, 1e-3, 1e-3);
  return clamp(rectangleOf(axis, 2.0 * asin(0.5 * chord)) + margin, -1.0, 1.0);
}

void main() {
  int receiver = tiles.z + gl_InstanceID;
  int number = gl_VertexID / 3;
  triangle = uint(number);
  coverage = texelFetch(holed, number).x;
  tile = tiles.x * ivec2(receiver % tiles.y, receiver / tiles.y);
  uvec4 first = texelFetch(receivers, 5 * receiver);
  mat3 toFrame = transpose(mat3(uintBitsToFloat(texelFetch(receivers, 5 * receiver + 1).xyz),
                                uintBitsToFloat(texelFetch(receivers, 5 * receiver + 2).xyz),
                                uintBitsToFloat(texelFetch(receivers, 5 * receiver + 3).xyz)));
  vec3 position = uintBitsToFloat(first.xyz);
  vec3 p0 = texelFetch(corners, 3 * number).xyz, p1 = texelFetch(corners, 3 * number + 1).xyz,
       p2 = texelFetch(corners, 3 * number + 2).xyz;
  vec3 d0 = toFrame * (p0 - position), d1 = toFrame * (p1 - position), d2 = toFrame * (p2 - position);
  // Differences of corners are exact to their own size, however far away they are.
  side0 = cross(d1, toFrame * (p2 - p1));
  side1 = cross(d2, toFrame * (p0 - p2));
  side2 = cross(d0, toFrame * (p1 - p0));
  vec3 across = cross(toFrame * (p1 - p0), toFrame * (p2 - p0));
  float determinant = dot(side0, d0);  // positive where the corners turn counter-clockwise
  if (determinant < 0.0) {
    side0 = -side0;
    side1 = -side1;
    side2 = -side2;
  }
  tolerances = rounding * vec3(length(side0), length(side1), length(side2));
  surface = across / (determinant == 0.0 ? 1.0 : determinant);

  bool own = first.w == triangle;
  ownNormal = own ? toFrame * uintBitsToFloat(texelFetch(receivers, 5 * receiver + 4).xyz) : vec3(0.0);
  float reach = sqrt(max(max(dot(d0, d0), dot(d1, d1)), dot(d2, d2)));
  bool inPlane = abs(determinant) <= flatness * reach * length(across);
  bool hidden = own ? ownNormal.z > 0.9999999 : inPlane || max(max(d0.z, d1.z), d2.z) <= 0.0;
  vec4 rectangle = own ? vec4(-1.0, -1.0, 1.0, 1.0) : rectangleAround(normalize(d0), normalize(d1), normalize(d2));
  hidden = hidden || any(greaterThanEqual(rectangle.xy, rectangle.zw));
  int corner = gl_VertexID % 3;
  vec2 place = rectangle.xy + (rectangle.zw - rectangle.xy) * vec2(corner == 1 ? 2.0 : 0.0, corner == 2 ? 2.0 : 0.0);
  vec2 pixel = vec2(tile) + 0.5 * float(tiles.x) * (place + 1.0);
  gl_Position = hidden ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(2.0 * pixel / float(tiles.w) - 1.0, 0.0, 1.0);
}
