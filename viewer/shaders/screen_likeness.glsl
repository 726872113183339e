// How alike two places of a picture are; needs screen_space.glsl.

// Of a place that is no farther from the plane of another than a pixel is wide, with a normal like its own.
float likeness(Seen a, Seen b, float pixel) {
  if (!b.there) return 0.0;
  float away = abs(dot(a.normal, b.place - a.place)) / pixel;
  return max(1.0 - 0.5 * away, 0.0) * smoothstep(0.8, 0.95, dot(a.normal, b.normal));
}
