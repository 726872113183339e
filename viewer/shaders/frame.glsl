// What a picture has in common for all its draws; mirrored by FrameBlock of renderer.cpp.
layout(std140) uniform Frame {
  mat4 clipFromScene;
  mat4 skyFromWorld;      // turns a world direction into the sky map's frame
  vec4 eye;               // xyz: position, scene coordinates; w: 1 perspective, 0 orthographic
  vec4 forward;           // xyz: unit view direction
  vec4 pixelRight;        // xyz: from the picture's centre to its right edge on the plane at unit depth
  vec4 pixelUp;
  vec4 tile;              // picture position -1..1 of this tile: scale xy, offset zw
  vec4 ambient[9];        // sky radiance convolved with the clamped cosine over pi, SH order 3, RGB
  vec4 transferLight[64]; // SH coefficients of sky and directional lights, RGB
  vec4 skyLevels;         // x: map's mip level per octave 0 (level 0 texel angle, log2), y: background's level
  ivec4 counts;           // x: lights, y: shading, z: SH order, w: SH channels
  vec4 window[2];         // factors of a delta light's bands 0..7
};

const int shadingPhong = 0;
const int shadingAo = 1;
const int shadingSh = 2;

const float pi = 3.14159265358979;
