// How alike two places of a picture are; needs screen_space.glsl.

// 1 where b lies in the plane of a and has its normal, less the farther it is from either; pixel: a pixel's width there.
float likeness(Seen a, Seen b, float pixel) {
  if (!b.there) return 0.0;
  float away = abs(dot(a.normal, b.place - a.place)) / pixel;
  return max(1.0 - 0.5 * away, 0.0) * smoothstep(0.8, 0.95, dot(a.normal, b.normal));
}
