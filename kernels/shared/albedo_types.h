// The table of what rough lobes reflect (transport/albedo_table_funcs.cl); GLSL reads this, too.
#ifndef PRELIGHT_SHARED_ALBEDO_TYPES_H
#define PRELIGHT_SHARED_ALBEDO_TYPES_H

// [roughness][cosine], then the means [roughness]; after them, [roughness][cosine] again, what solid rough glass scatters, for
// each index of refraction. Cosines and roughnesses are squares of equal steps from 0 to 1.
#define PRELIGHT_LEAST_SHEEN_ROUGHNESS 0.07f  // a sharper sheen is lost between the entries
#define PRELIGHT_ALBEDO_COSINES 48
#define PRELIGHT_ALBEDO_ROUGHNESSES 32
#define PRELIGHT_GLASS_COSINES 24
#define PRELIGHT_GLASS_ROUGHNESSES 16

#endif
