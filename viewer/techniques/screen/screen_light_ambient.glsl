// The light that screen-space occlusion finds.
const bool isSender = false;
const bool findsBounce = false;
#include "screen_found_light.glsl"
