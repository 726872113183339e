#version 410 core
// A vertex as a receiver sees it: viewer/hemisphere/hemisphere_map.h.
layout(location = 0) in vec3 position;
layout(location = 7) in vec3 radiance;

uniform vec3 receiver;
uniform mat4 toFace;    // from the scene's axes to right, up and forward
uniform vec4 window;    // left, right, bottom, top of the plane at distance 1
uniform vec4 depths;    // x: nearest, y: farthest, z: 1 stereographic, 2 orthographic

out vec3 vRadiance;

void main() {
  vRadiance = radiance;
  vec3 d = mat3(toFace) * (position - receiver);
  if (depths.z > 0.5) {
    float distance = max(length(d), 1e-30);
    vec3 w = d / distance;
    // Edges are drawn straight: what lies along the horizon, as the receiver's own triangle, would cover the disc. A degree
    // above it counts 4e-4 of all.
    gl_ClipDistance[0] = w.z - 0.02;
    vec2 place = depths.z > 1.5 ? w.xy : w.xy / max(1.0 + w.z, 1e-3);
    gl_Position = vec4(place, 2.0 * distance / depths.y - 1.0, 1.0);
    return;
  }
  gl_ClipDistance[0] = 1.0;
  vec2 centre = 0.5 * (window.xz + window.yw);
  vec2 halfSize = 0.5 * (window.yw - window.xz);
  float depth = (d.z * (depths.y + depths.x) - 2.0 * depths.x * depths.y) / (depths.y - depths.x);
  gl_Position = vec4((d.xy - centre * d.z) / halfSize, depth, d.z);
}
