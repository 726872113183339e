// Layout of the reflectance table of a measured material (transport/measured_funcs.cl).
#ifndef PRELIGHT_SHARED_MEASURED_TYPES_H
#define PRELIGHT_SHARED_MEASURED_TYPES_H

// A table holds albedos [cosine][3], where cosines are squares of equal steps from 0 to 1, then values
// [half][difference][turn][3].
#define PRELIGHT_MEASURED_COSINES 48
#define PRELIGHT_MEASURED_HALVES 90
#define PRELIGHT_MEASURED_DIFFERENCES 90
#define PRELIGHT_MEASURED_TURNS 180
#define PRELIGHT_NO_MEASURED 0xffffffffu

#endif
