// Virtual point lights (Keller 1997), as kernels/transport/virtual_light_funcs.cl has them, with the shadows of their maps; needs
// frame.glsl, scattering.glsl and shadows.glsl. Layers of a clear coat or sheen do not dim them.
uniform samplerBuffer virtualLights;  // [light]: its ShadowLight, then what readVirtualLight() takes
uniform sampler2DArray virtualMaps;
uniform samplerBuffer virtualViews;
uniform int virtualCount;
uniform float virtualLeastSquare;  // m2; nearer than its root a light counts as at that distance

const int virtualTexels = 9;

struct VirtualLight {
  vec3 position;
  vec3 geometric;  // unit normal of its triangle, on the side that shines
  vec3 normal;     // for shading
  vec3 intensity;  // W/sr along `geometric`, without the layer's loss on the way out
  vec3 through;    // W/sr the other way
  vec3 layer;      // over its body: along the normal, at grazing angles, later
  float roughness;
  float nearby;      // of VirtualLight in kernels/shared/reference_types.h
};

VirtualLight readVirtualLight(int light, out ShadowLight shadow) {
  int at = virtualTexels * light;
  shadow = ShadowLight(texelFetch(virtualLights, at), texelFetch(virtualLights, at + 1), texelFetch(virtualLights, at + 2),
                       texelFetch(virtualLights, at + 3));
  vec4 intensity = texelFetch(virtualLights, at + 4), normal = texelFetch(virtualLights, at + 5);
  vec4 through = texelFetch(virtualLights, at + 6), geometric = texelFetch(virtualLights, at + 7);
  return VirtualLight(shadow.place.xyz, geometric.xyz, normal.xyz, intensity.rgb, through.rgb,
                      vec3(intensity.w, normal.w, through.w), geometric.w, texelFetch(virtualLights, at + 8).x);
}

// Share of the light inside the body of a virtual light that leaves in a direction of this cosine.
float leavesVirtual(VirtualLight light, float cosine) {
  if (largest(light.layer) <= 0.0) return 1.0;
  return passedLayer(light.layer, light.roughness >= smoothBelow ? lobeAlbedo(albedos, cosine, light.roughness).xy : smoothBounce(cosine));
}

// Returns the irradiance by a virtual light of a surface with unit normal n, W/m2. `geometric`: normal of its triangle.
vec3 irradianceOfVirtual(int index, vec3 point, vec3 n, vec3 geometric) {
  ShadowLight shadow;
  VirtualLight light = readVirtualLight(index, shadow);
  vec3 path = light.position - point;
  float distance2 = dot(path, path);
  if (distance2 <= 1e-18) return vec3(0.0);
  vec3 toLight = path * inversesqrt(distance2);
  float arriving = dot(n, toLight);
  if (arriving <= 0.0 || dot(geometric, toLight) <= 0.0) return vec3(0.0);
  float cosine = -dot(light.normal, toLight), leaving = -dot(light.geometric, toLight);
  vec3 intensity = light.intensity;
  if (cosine < 0.0 && leaving < 0.0) {
    intensity = light.through;
    cosine = -cosine;
    leaving = -leaving;
  }
  if (cosine <= 0.0 || leaving <= 0.0 || largest(intensity) <= 0.0) return vec3(0.0);
  float given = 1.0 + light.nearby * max(1.0 - distance2 / virtualLeastSquare, 0.0);
  float falloff = leaving * leavesVirtual(light, cosine) * given / max(distance2, virtualLeastSquare);
  return intensity * (falloff * arriving * shareByMaps(virtualMaps, virtualViews, shadow, point, geometric, 0));
}

// Irradiance of all virtual lights. Pixels take turns with them, as with samples of large lights.
vec3 virtualIrradiance(vec3 point, vec3 n, vec3 geometric) {
  ivec2 turn = ivec2(gl_FragCoord.xy) % counts.z;
  int stride = counts.z * counts.z;
  vec3 sum = vec3(0.0);
  for (int k = turn.x + counts.z * turn.y; k < virtualCount; k += stride) sum += irradianceOfVirtual(k, point, n, geometric);
  return float(stride) * sum;
}
