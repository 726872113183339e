// Shadows of lights by shadow maps (viewer/shadows/shadow_maps.h).
// A depth is near / z where a light looks from a point and 0.5 - scale z where from a direction, 0 where there is
// nothing: both are affine in the map's coordinates across a plane, so that the plane of a surface is known exactly at
// every texel.
uniform sampler2DArray shadowMaps;
uniform samplerBuffer shadowViews;   // [view]: corner in texels, layer, side

struct ShadowLight {
  vec4 axisX;  // w: first view
  vec4 axisY;  // w: views
  vec4 axisZ;  // w: nearest depth, m; of a direction: depths a metre, negative
  vec4 place;  // w: half sides a tangent, or a metre
};

layout(std140) uniform ShadowLights { ShadowLight shadowLights[240]; };

// Part of a texel, more than rounding in the rasteriser moves the edges of triangles by.
const float roundedTexels = 0.1;
// Share of a texel's width by which a neighbouring facet may be nearer and still belong to the same curved surface.
const float facetTexels = 0.4;

// The view of a cube that a direction falls into, and the direction in its frame.
int faceOf(inout vec3 way, inout vec3 normal) {
  vec3 size = abs(way);
  bool alongZ = size.z >= max(size.x, size.y);
  bool alongX = !alongZ && size.x >= size.y;
  way = alongZ ? way : alongX ? way.yzx : way.zxy;
  normal = alongZ ? normal : alongX ? normal.yzx : normal.zxy;
  bool forward = way.z >= 0.0;
  float side = forward ? 1.0 : -1.0;
  way.z *= side;
  normal.z *= side;
  if (alongZ) return forward ? 0 : 5;
  int first = alongX ? 1 : 3;
  return forward ? first : first + 1;
}

// Depth of the surface at its place in the map (z), and how it changes a half side along x and y (xy).
vec3 planeDepth(vec3 way, vec3 normal, float near, float scale, float depthScale) {
  if (near > 0.0) return vec3(normal.xy * near / (scale * dot(normal, way)), near / way.z);
  return vec3(depthScale * normal.xy / (scale * normal.z), 0.5 - depthScale * way.z);
}

// Which of the two by two texels from `low` on do not stand in the light's way at their depths: (0, 1), (1, 1), (1, 0),
// (0, 0), the order of textureGather, which is one look-up for four.
// `texel`: of the map, of which it is 1.
vec4 lit(sampler2DArray maps, vec2 low, float layer, vec4 depths, vec2 texel) {
  vec2 corner = (low + 1.0) * texel;
  return vec4(lessThanEqual(textureGather(maps, vec3(corner, layer)), depths));
}

// Share of a light that reaches a point of a surface, 0 to 1, by its maps and the places of all views in them. `normal`: of its
// triangle, on the light's side. `reach`: texels around the point that count with all their weight, 0 or 1; one more has a share.
float shareByMaps(sampler2DArray maps, samplerBuffer placesOfViews, ShadowLight light, vec3 point, vec3 normal, int reach) {
  vec4 axisX = light.axisX;
  vec4 axisY = light.axisY;
  int views = int(axisY.w + 0.5);
  if (views == 0) return 1.0;
  vec4 axisZ = light.axisZ;
  vec4 place = light.place;
  float near = max(axisZ.w, 0.0);
  vec3 away = point - place.xyz;
  vec3 way = vec3(dot(axisX.xyz, away), dot(axisY.xyz, away), dot(axisZ.xyz, away));
  vec3 n = vec3(dot(axisX.xyz, normal), dot(axisY.xyz, normal), dot(axisZ.xyz, normal));
  int face = views > 1 ? faceOf(way, n) : 0;
  if (face >= views || (near > 0.0 && way.z <= near)) return 1.0;
  float depthScale = max(-axisZ.w, 0.0);

  vec4 view = texelFetch(placesOfViews, int(axisX.w + 0.5) + face);
  vec2 at = place.w * way.xy / (near > 0.0 ? way.z : 1.0);
  if (max(abs(at.x), abs(at.y)) >= 1.0) return 1.0;
  vec3 plane = planeDepth(way, n, near, place.w, depthScale);
  float width = 2.0 / view.w;  // of a texel, in half sides
  vec2 slope = plane.xy * width;
  // A texel's width on a surface that faces the light, as a depth.
  float texelDepth = width / place.w * (near > 0.0 ? plane.z : depthScale);
  float bias = roundedTexels * (abs(slope.x) + abs(slope.y)) + facetTexels * texelDepth +
               (near > 0.0 ? 1e-5 * plane.z : 1e-6);

  vec2 texel = (0.5 * at + 0.5) * view.w - 0.5;
  vec2 low = clamp(floor(texel), vec2(float(reach)), vec2(view.w - 2.0 - float(reach)));
  vec2 share = clamp(texel - low, 0.0, 1.0);
  float first = plane.z + dot(slope, low - texel) + bias;
  vec2 texelOfMap = 1.0 / vec2(textureSize(maps, 0).xy);
  float sum = 0.0;
  for (int y = -reach; y <= reach; y += 2) {
    vec2 weightsY = vec2(y == -reach ? 1.0 - share.y : 1.0, y + 1 == reach + 1 ? share.y : 1.0);
    for (int x = -reach; x <= reach; x += 2) {
      vec2 weightsX = vec2(x == -reach ? 1.0 - share.x : 1.0, x + 1 == reach + 1 ? share.x : 1.0);
      float depth = first + dot(slope, vec2(x, y));
      vec4 depths = depth + vec4(slope.y, slope.x + slope.y, slope.x, 0.0);
      vec4 passes = lit(maps, view.xy + low + vec2(x, y), view.z, depths, texelOfMap);
      sum += dot(passes, vec4(weightsX.x * weightsY.y, weightsX.y * weightsY.y, weightsX.y * weightsY.x, weightsX.x * weightsY.x));
    }
  }
  float span = float(2 * reach + 1);
  return sum / (span * span);
}

float visibility(int light, vec3 point, vec3 normal, int reach) {
  return shareByMaps(shadowMaps, shadowViews, shadowLights[light], point, normal, reach);
}
