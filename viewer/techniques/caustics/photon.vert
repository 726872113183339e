#version 410 core
// A photon as a point.
#include "frame.glsl"

layout(location = 0) in vec3 position;  // scene coordinates
layout(location = 1) in vec3 power;     // W
layout(location = 2) in float place;    // of surface_places.glsl

flat out vec3 vPhoton;
flat out vec3 vPower;
flat out float vPlace;

void main() {
  vPhoton = position;
  vPower = power;
  vPlace = place;
  gl_Position = clipFromScene * vec4(position, 1.0);
}
