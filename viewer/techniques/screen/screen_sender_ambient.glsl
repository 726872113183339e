// What a surface sends on of the light that screen-space occlusion finds: nothing but what it scatters of that.
const bool isSender = true;
const bool findsBounce = false;
#include "screen_found_light.glsl"
