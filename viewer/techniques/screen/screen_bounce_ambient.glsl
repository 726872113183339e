// The light that screen-space occlusion finds, and what surfaces send on of it.
const bool isSender = false;
const bool findsBounce = true;
#include "screen_found_light.glsl"
