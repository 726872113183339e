// Layout of the table of the albedos of rough lobes (transport/albedo_table_funcs.cl). Also compiled as GLSL.
#ifndef PRELIGHT_SHARED_ALBEDO_TYPES_H
#define PRELIGHT_SHARED_ALBEDO_TYPES_H

// The table holds albedos [roughness][cosine], then their means [roughness] and where lobes lie
// [roughness][cosine]; after the tables of all lobes, [roughness][cosine] of what solid rough glass scatters,
// for each index of refraction. Cosines and
// roughnesses are squares of equal steps from 0 to 1.
#define PRELIGHT_LEAST_SHEEN_ROUGHNESS 0.07f  // sharper sheen falls between the entries
#define PRELIGHT_ALBEDO_COSINES 48
#define PRELIGHT_ALBEDO_ROUGHNESSES 32
// Behind these, if some material is anisotropic, the albedos of anisotropic lobes:
// [across][stretch][height][texel], then their means [across][stretch]
// (transport/anisotropic_albedo_funcs.cl).
#define PRELIGHT_ANISOTROPIC_TEXELS 8
#define PRELIGHT_ANISOTROPIC_REACHES 22  // three per texel, and one more

#define PRELIGHT_LEANS_FIRST (PRELIGHT_ALBEDO_ROUGHNESSES * (PRELIGHT_ALBEDO_COSINES + 1))
#define PRELIGHT_ANISOTROPIC_FIRST (PRELIGHT_LEANS_FIRST + PRELIGHT_ALBEDO_ROUGHNESSES * PRELIGHT_ALBEDO_COSINES)
#define PRELIGHT_ANISOTROPIC_ACROSS 16
#define PRELIGHT_ANISOTROPIC_STRETCHES 16
#define PRELIGHT_ANISOTROPIC_HEIGHTS 24
#define PRELIGHT_ANISOTROPIC_ROWS (PRELIGHT_ANISOTROPIC_ACROSS * PRELIGHT_ANISOTROPIC_STRETCHES)
#define PRELIGHT_ANISOTROPIC_SIZE (PRELIGHT_ANISOTROPIC_ROWS * (PRELIGHT_ANISOTROPIC_TEXELS * PRELIGHT_ANISOTROPIC_HEIGHTS + 1))
#define PRELIGHT_ANISOTROPIC_END (PRELIGHT_ANISOTROPIC_FIRST + PRELIGHT_ANISOTROPIC_SIZE)
// For each film over a dielectric, a table [thickness][roughness][cosine], then the means
// [thickness][roughness].
#define PRELIGHT_FILM_THICKNESSES 24
#define PRELIGHT_FILM_ROUGHNESSES 16
#define PRELIGHT_FILM_COSINES 32
#define PRELIGHT_GLASS_COSINES 24
#define PRELIGHT_GLASS_ROUGHNESSES 16

#endif
