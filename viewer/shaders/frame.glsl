// Values that all draws of a picture share; mirrored by FrameBlock of uniform_blocks.h.
layout(std140) uniform Frame {
  mat4 clipFromScene;
  mat4 skyFromWorld;      // turns a world direction into the sky map's frame
  vec4 eye;               // xyz: position, scene coordinates; w: 1 perspective, 0 orthographic
  vec4 forward;           // xyz: unit view direction
  vec4 pixelRight;        // xyz: from the picture's centre to its right edge on the plane at unit depth; of an orthographic one, anywhere
  vec4 pixelUp;
  vec4 tile;              // picture position -1..1 of this tile: scale xy, offset zw
  vec4 ambient[9];        // sky radiance convolved with the clamped cosine over pi, SH order 3, RGB; W of the first: strength of smoothing, ambientInCone()
  vec4 skyLevels;         // x: map's mip level per octave 0 (level 0 texel angle, log2), y: background's level, z: 1: ambient lacks the sky's lamps, which are lights
  ivec4 counts;           // x: lights, y: those of them that are not samples, z: samples of a pixel's side
};

const float pi = 3.14159265358979;
