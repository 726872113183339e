// Places of marks; needs frame.glsl.
uniform vec2 lift;  // towards the eye, so that a mark on a surface is before it: share of the distance; m in orthographic pictures

// Clip coordinates of a mark. Its pixel is that of the place itself.
vec4 clipOfMark(vec3 place) {
  vec3 lifted = eye.w > 0.5 ? mix(place, eye.xyz, lift.x) : place - lift.y * forward.xyz;
  return clipFromScene * vec4(lifted, 1.0);
}
