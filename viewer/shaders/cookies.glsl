// Pictures that spot lights project; needs `lampTables` of lights.glsl, where LampTables has packed them: (width, height, scale and
// offset of the cone), (direction of the side, cotangent of the outer angle), texels row by row from the top.

struct Cookie {
  int first;  // texel
  int width;
  int height;
  vec2 cone;
  vec3 side;
  float cotangent;
};

Cookie cookieAt(int entry) {
  vec4 head = FETCH(lampTables, entry);
  vec4 place = FETCH(lampTables, entry + 1);
  return Cookie(entry + 2, int(head.x + 0.5), int(head.y + 0.5), head.zw, place.xyz, place.w);
}

vec3 cookieTexel(Cookie c, int column, int row) {
  int x = clamp(column, 0, c.width - 1);
  int y = clamp(row, 0, c.height - 1);
  return FETCH(lampTables, c.first + y * c.width + x).rgb;
}

// Returns the share of a lamp's light in the direction in which it leaves, for a lamp with this axis: cookieTowards() of host/scene/light_profile.h
// within the cone.
vec3 throughCookie(Cookie c, vec3 axis, vec3 direction) {
  float along = dot(direction, axis);
  float angular = clamp(along * c.cone.x + c.cone.y, 0.0, 1.0);
  if (along <= 0.0 || angular <= 0.0) return vec3(0.0);
  vec2 place = vec2(dot(direction, c.side), dot(direction, cross(axis, c.side))) * (c.cotangent / along);
  vec2 texel = 0.5 * (vec2(1.0) - place) * vec2(c.width, c.height) - vec2(0.5);
  vec2 corner = floor(texel);
  vec2 within = texel - corner;
  int x = int(corner.x);
  int y = int(corner.y);
  vec3 above = mix(cookieTexel(c, x, y), cookieTexel(c, x + 1, y), within.x);
  vec3 below = mix(cookieTexel(c, x, y + 1), cookieTexel(c, x + 1, y + 1), within.x);
  return angular * angular * mix(above, below, within.y);
}
