// Macros for what OpenCL C and GLSL name differently, for files that compile as both. Such files use float and int,
// vec3 and vec4, structs by value, literals with f, and functions that the two languages share.
#ifndef PRELIGHT_CORE_DIALECT_H
#define PRELIGHT_CORE_DIALECT_H

#ifdef __OPENCL_C_VERSION__
#include "core/inline.h"
#define vec2 float2
#define vec3 float3
#define vec4 float4
#define VEC2 (float2)
#define VEC3 (float3)
#define VEC4 (float4)
#define TO_FLOAT(x) ((float)(x))
#define TO_INT(x) ((int)(x))
#define BITS_OF(x) as_int(x)
#define FLOAT_OF_BITS(x) as_float(x)
#define ABS fabs
#define MAX fmax
#define ATAN2 atan2
#define INVERSE_SQRT rsqrt
#define STRUCT_NAME(name) typedef struct name name;
#define TEXELS __global const float4*
#define FETCH(texels, index) (texels)[index]
#else
#define PRELIGHT_INLINE
#define VEC2 vec2
#define VEC3 vec3
#define VEC4 vec4
#define TO_FLOAT(x) float(x)
#define TO_INT(x) int(x)
#define BITS_OF(x) floatBitsToInt(x)
#define FLOAT_OF_BITS(x) intBitsToFloat(x)
#define ABS abs
#define MAX max
#define ATAN2 atan
#define INVERSE_SQRT inversesqrt
#define STRUCT_NAME(name)
#ifdef GL_ES
// WebGL 2 has no buffer textures. A 2D texture with rows of 2048 texels, a width that every implementation supports,
// replaces them.
#define TEXELS sampler2D
#define UTEXELS usampler2D
#define ITEXELS isampler2D
#define FETCH(texels, index) texelFetch(texels, ivec2((index) & 2047, (index) >> 11), 0)
#else
#define TEXELS samplerBuffer
#define UTEXELS usamplerBuffer
#define ITEXELS isamplerBuffer
#define FETCH(texels, index) texelFetch(texels, index)
#endif
#endif

#endif
