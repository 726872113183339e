#include "cosine_lobe.glsl"
