// Cube maps: faces +X, -X, +Y, -Y, +Z, -Z, each oriented as in OpenGL; texel index = face x faceSize^2 + row x faceSize
// + column. The host's counterpart is host/basis/cube_map.h.
#ifndef PRELIGHT_HAAR_CUBE_FUNCS_CL
#define PRELIGHT_HAAR_CUBE_FUNCS_CL

// Returns the texel in which a direction (any length but 0) lies. Table of the OpenGL specification, "Cube map texture
// selection".
uint cubeTexel(float3 d, uint faceSize) {
  const float3 a = fabs(d);
  uint face;
  float s, t, m;
  if (a.x >= a.y && a.x >= a.z) {
    face = d.x < 0.0f ? 1u : 0u;
    s = d.x < 0.0f ? d.z : -d.z;
    t = -d.y;
    m = a.x;
  } else if (a.y >= a.z) {
    face = d.y < 0.0f ? 3u : 2u;
    s = d.x;
    t = d.y < 0.0f ? -d.z : d.z;
    m = a.y;
  } else {
    face = d.z < 0.0f ? 5u : 4u;
    s = d.z < 0.0f ? -d.x : d.x;
    t = -d.y;
    m = a.z;
  }
  const float scale = 0.5f * (float)faceSize;
  const uint column = min((uint)fmax(scale * (s / m) + scale, 0.0f), faceSize - 1u);
  const uint row = min((uint)fmax(scale * (t / m) + scale, 0.0f), faceSize - 1u);
  return (face * faceSize + row) * faceSize + column;
}

#endif
