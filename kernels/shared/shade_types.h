// Materials and lights as kernels that follow light read them.
#ifndef PRELIGHT_SHARED_SHADE_TYPES_H
#define PRELIGHT_SHARED_SHADE_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

#define PRELIGHT_SOLID 1u         ///< glass with an inside: refracts
#define PRELIGHT_DOUBLE_SIDED 2u  ///< emits from both sides, both of which pictures show
#define PRELIGHT_UNLIT 4u         ///< shows its base colour to the camera, is black otherwise

#define PRELIGHT_NO_MEDIUM 0xffffffffu

// Textures of a ShadeMaterial besides that of its base colour.
#define PRELIGHT_SURFACE_TEXTURE 0u  // G roughness, B metalness
#define PRELIGHT_EMISSION_TEXTURE 1u
#define PRELIGHT_GLASS_TEXTURE 2u     // R
#define PRELIGHT_SPECULAR_TEXTURE 3u  // A
#define PRELIGHT_SPECULAR_COLOR_TEXTURE 4u
#define PRELIGHT_THROUGH_TEXTURE 5u  // A
#define PRELIGHT_THROUGH_COLOR_TEXTURE 6u
#define PRELIGHT_NORMAL_TEXTURE 7u
#define PRELIGHT_COAT_TEXTURE 8u            // R
#define PRELIGHT_COAT_ROUGHNESS_TEXTURE 9u  // G
#define PRELIGHT_SHEEN_COLOR_TEXTURE 10u
#define PRELIGHT_SHEEN_ROUGHNESS_TEXTURE 11u  // A
#define PRELIGHT_ANISOTROPY_TEXTURE 12u       // RG direction, B strength
#define PRELIGHT_COAT_NORMAL_TEXTURE 13u
#define PRELIGHT_FILM_TEXTURE 14u            // R
#define PRELIGHT_FILM_THICKNESS_TEXTURE 15u  // G
#define PRELIGHT_SHADE_TEXTURES 16u

typedef struct ShadeMaterial {
  float f0[3];          ///< reflectance of the dielectric's surface along its normal; bounded by 1, and times
                        ///< `specular`
  float specular;       ///< its strength, and reflectance at grazing angles
  float absorption[3];  ///< inside, 1/m, with what is scattered
  float ior;            ///< 0: infinite
  float emission[3];    ///< W/(m2 sr)
  float metallic;
  float roughness;
  float transmission;
  uint flags;          ///< PRELIGHT_SOLID | ...
  float throughShare;  ///< of the body's light, leaves on the other side
  float through[3];    ///< colour of that light
  float normalScale;   ///< of the x and y of its normal texture
  float sheen[3];      ///< colour
  float sheenRoughness;
  float coat;  ///< share of the surface that has a clear coat
  float coatRoughness;
  float coatNormalScale;    ///< of the x and y of its normal texture
  float anisotropy;         ///< strength
  float anisotropyTurn[2];  ///< cosine and sine of its rotation
  float film;               ///< share of the surface under a thin film
  float filmIor;
  float filmThickness[2];  ///< nm, where its texture is 0 and 1
  uint filmTable;  ///< entry of the table of albedos at which that of what dielectrics reflect under the film
                   ///< begins
  float dispersion;         ///< 20 over Abbe's number, of glass
  float scattering[3];      ///< inside, share of `absorption` that is scattered on; 0: none
  float scatterAnisotropy;  ///< mean cosine of one scattering
  uint measured;  ///< of a measured material: where its table begins (transport/measured_funcs.cl), else
                  ///< PRELIGHT_NO_MEASURED
  float measuredShare;  ///< chance with which that is sampled by the cosine, not by the lobe
  uint glassTable;      ///< of solid rough glass: entry of the table of albedos at which its own begins
  uint textures[PRELIGHT_SHADE_TEXTURES];  ///< places in the list of textures, or PRELIGHT_NO_TEXTURE
} ShadeMaterial;

#define PRELIGHT_POINT_LIGHT 0u
#define PRELIGHT_DIRECTIONAL_LIGHT 1u
#define PRELIGHT_SPOT_LIGHT 2u
#define PRELIGHT_PROFILED_LIGHT 3u  ///< shines as transport/profile_funcs.cl tells

typedef struct PunctualLight {
  float position[3];  ///< scene coordinates
  uint kind;
  float intensity[3];  ///< W/sr; directional: W/m2
  float inverseRange;  ///< 1/m; 0: infinite
  float direction[3];  ///< unit, the way the light travels; a profile's pole
  float coneScale;     ///< KHR_lights_punctual: clamp(cosine x scale + offset, 0, 1) squared
  float coneOffset;
  uint profile;        ///< entry at which its profile begins
  uint profileTable;   ///< first entry in the tables of the chances of its columns, then of rows a column
  float profileStart;  ///< where the profile's turns begin
} PunctualLight;

#define PRELIGHT_NO_EMITTER 0xffffffffu
#define PRELIGHT_EMITTER_LEAF 0x80000000u  ///< set in a reference to an emitter, not to parts of a triangle

/// Emissive triangles, or parts of such, that one is chosen of.
typedef struct EmitterRange {
  uint first;  ///< in the list of emitters
  uint count;
  uint table;  ///< first entry of their intervals in the tables
} EmitterRange;

/// Where what lights are chosen by lies in its table (transport/light_table_funcs.cl).
typedef struct LightLayout {
  uint groupCount;    ///< of lights to choose from: punctual lights, then the emitters as one, then the sky
  uint emitterGroup;  ///< number of the groups before the emitters and the sky
  uint emitterCount;
  uint emitterTable;  ///< first entry in the tables; that of the groups starts at 0
  uint rowTable;
  uint columnTable;
  uint skyWidth;
  uint skyHeight;
  float skyTurn;  ///< of the sky counter-clockwise seen from above, in turns
} LightLayout;

PRELIGHT_SHARED_END

#endif
