// Materials and lights as path tracing kernels read them.
#ifndef PRELIGHT_SHARED_SHADE_TYPES_H
#define PRELIGHT_SHARED_SHADE_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

#define PRELIGHT_SOLID 1u         ///< glass with an inside, which refracts
#define PRELIGHT_DOUBLE_SIDED 2u  ///< both sides emit, and pictures show both
#define PRELIGHT_UNLIT 4u         ///< shows its base colour to the camera and is black otherwise

#define PRELIGHT_NO_MEDIUM 0xffffffffu

// Indices of a ShadeMaterial's textures; the base colour's is elsewhere.
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

/// A material as path tracing evaluates it.
typedef struct ShadeMaterial {
  /// Reflectance of the dielectric's surface along its normal; is multiplied by `specular` and bounded by 1.
  float f0[3];
  float specular;       ///< strength of the dielectric's reflection, and reflectance at grazing angles
  float absorption[3];  ///< extinction inside, 1/m, including scattering
  float ior;            ///< 0 when infinite
  float emission[3];    ///< W/(m2 sr)
  float metallic;
  float roughness;
  float transmission;
  uint flags;          ///< PRELIGHT_SOLID | ...
  float throughShare;  ///< share of the body's light that leaves on the other side
  float through[3];    ///< colour of that light
  float normalScale;   ///< scale of the x and y of its normal texture
  float sheen[3];      ///< colour
  float sheenRoughness;
  float coat;  ///< share of the surface that has a clear coat
  float coatRoughness;
  float coatNormalScale;    ///< scale of the x and y of the coat's normal texture
  float anisotropy;         ///< strength
  float anisotropyTurn[2];  ///< cosine and sine of its rotation
  float film;               ///< share of the surface under a thin film
  float filmIor;
  float filmThickness[2];  ///< nm, where its texture is 0 and 1
  /// Entry of the albedo table at which the table of dielectrics under the film begins.
  uint filmTable;
  float dispersion;         ///< glass: 20 divided by Abbe's number
  float scattering[3];      ///< albedo inside: share of `absorption` that is scattered; 0: none
  float scatterAnisotropy;  ///< mean cosine of one scattering
  /// Measured materials: first entry of its table (transport/measured_funcs.cl); otherwise
  /// PRELIGHT_NO_MEASURED.
  uint measured;
  /// Probability of sampling the measured material by the cosine rather than by the lobe.
  float measuredShare;
  uint glassTable;  ///< solid rough glass: entry of the albedo table at which its own begins
  uint textures[PRELIGHT_SHADE_TEXTURES];  ///< indices in the list of textures, or PRELIGHT_NO_TEXTURE
} ShadeMaterial;

#define PRELIGHT_POINT_LIGHT 0u
#define PRELIGHT_DIRECTIONAL_LIGHT 1u
#define PRELIGHT_SPOT_LIGHT 2u
#define PRELIGHT_PROFILED_LIGHT 3u  ///< shines as described in transport/profile_funcs.cl

/// A point, spot, directional or profiled light.
typedef struct PunctualLight {
  float position[3];  ///< scene coordinates
  uint kind;
  float intensity[3];  ///< W/sr; directional: W/m2
  float inverseRange;  ///< 1/m; 0 when infinite
  float direction[3];  ///< unit direction in which the light travels; the pole of a profile
  float coneScale;     ///< KHR_lights_punctual: clamp(cosine x scale + offset, 0, 1) squared
  float coneOffset;
  uint profile;  ///< first entry of its profile
  /// First entry, in the tables, of the probabilities of its columns, which those of the rows of each column
  /// follow.
  uint profileTable;
  float profileStart;  ///< azimuth at which the profile's turns begin
  float radius;        ///< of its ball, m; directional: half the angle of its disk, rad; 0: none
  uint pad[3];
} PunctualLight;

#define PRELIGHT_NO_EMITTER 0xffffffffu
/// Set in a reference to an emitter rather than to a node of a triangle's parts.
#define PRELIGHT_EMITTER_LEAF 0x80000000u

/// Emissive triangles, or parts of one, from which one is chosen.
typedef struct EmitterRange {
  uint first;  ///< index in the list of emitters
  uint count;
  uint table;  ///< first entry of their intervals in the tables
} EmitterRange;

/// Places of the light selection tables (transport/light_table_funcs.cl).
typedef struct LightLayout {
  /// Groups from which light is chosen: punctual lights, then all emitters as one, then the sky.
  uint groupCount;
  uint emitterGroup;  ///< number of groups before the emitters and the sky
  uint emitterCount;
  uint emitterTable;  ///< first entry in the tables; that of the groups is 0
  uint rowTable;
  uint columnTable;
  uint skyWidth;
  uint skyHeight;
  float skyTurn;  ///< rotation of the sky counter-clockwise seen from above, in turns
} LightLayout;

PRELIGHT_SHARED_END

#endif
