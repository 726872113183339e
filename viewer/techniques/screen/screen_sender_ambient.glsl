// A sender shows nothing but the scattered part of the light that screen-space occlusion finds.
const bool isSender = true;
const bool findsBounce = false;
#include "screen_found_light.glsl"
