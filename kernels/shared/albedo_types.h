// The table of what rough lobes reflect (transport/albedo_table_funcs.cl); GLSL reads this, too.
#ifndef PRELIGHT_SHARED_ALBEDO_TYPES_H
#define PRELIGHT_SHARED_ALBEDO_TYPES_H

// [roughness][cosine], then the means [roughness]; after all tables of lobes, [roughness][cosine] again, what solid rough glass
// scatters, for each index of refraction. Cosines and roughnesses are squares of equal steps from 0 to 1.
#define PRELIGHT_LEAST_SHEEN_ROUGHNESS 0.07f  // a sharper sheen is lost between the entries
#define PRELIGHT_ALBEDO_COSINES 48
#define PRELIGHT_ALBEDO_ROUGHNESSES 32
// Behind the means, where something is anisotropic, what such lobes reflect: [across][stretch][height][texel], then their
// means [across][stretch] (transport/anisotropic_albedo_funcs.cl).
#define PRELIGHT_ANISOTROPIC_TEXELS 8
#define PRELIGHT_ANISOTROPIC_REACHES 22  // three a texel, and one

#define PRELIGHT_ANISOTROPIC_FIRST (PRELIGHT_ALBEDO_ROUGHNESSES * (PRELIGHT_ALBEDO_COSINES + 1))
#define PRELIGHT_ANISOTROPIC_ACROSS 16
#define PRELIGHT_ANISOTROPIC_STRETCHES 16
#define PRELIGHT_ANISOTROPIC_HEIGHTS 24
#define PRELIGHT_ANISOTROPIC_ROWS (PRELIGHT_ANISOTROPIC_ACROSS * PRELIGHT_ANISOTROPIC_STRETCHES)
#define PRELIGHT_ANISOTROPIC_SIZE (PRELIGHT_ANISOTROPIC_ROWS * (PRELIGHT_ANISOTROPIC_TEXELS * PRELIGHT_ANISOTROPIC_HEIGHTS + 1))
#define PRELIGHT_ANISOTROPIC_END (PRELIGHT_ANISOTROPIC_FIRST + PRELIGHT_ANISOTROPIC_SIZE)
// A table for each film over a dielectric: [thickness][roughness][cosine], then the means [thickness][roughness].
#define PRELIGHT_FILM_THICKNESSES 24
#define PRELIGHT_FILM_ROUGHNESSES 16
#define PRELIGHT_FILM_COSINES 32
#define PRELIGHT_GLASS_COSINES 24
#define PRELIGHT_GLASS_ROUGHNESSES 16

#endif
