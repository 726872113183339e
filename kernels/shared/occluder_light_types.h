// Lighting of vector occluders: types that OpenCL C, GLSL and the host share. GLSL includes this text
// unchanged, so structs hold only float and int.
#ifndef PRELIGHT_SHARED_OCCLUDER_LIGHT_TYPES_H
#define PRELIGHT_SHARED_OCCLUDER_LIGHT_TYPES_H

#ifdef __cplusplus
namespace prelight::device {
#endif
#ifdef __OPENCL_C_VERSION__
typedef struct OccluderLight OccluderLight;
typedef struct OccluderTerms OccluderTerms;
typedef struct OccluderReceiverPoint OccluderReceiverPoint;
typedef struct LitVertex LitVertex;
#endif

#define PRELIGHT_LIGHT_DIRECTIONAL 0
#define PRELIGHT_LIGHT_POINT 1
#define PRELIGHT_LIGHT_SPOT 2
#define PRELIGHT_LIGHT_EMITTER 3

/// A light in scene coordinates; shaders read it as four vec4.
struct OccluderLight {
  float position[3];
  float kind;          ///< PRELIGHT_LIGHT_...
  float direction[3];  ///< unit; direction in which the light travels, or an emitter's normal
  float extent;        ///< emitter: area, m2; point and spot: least distance that counts, squared, m2
  float intensity[3];  ///< W/sr, W/m2 (directional), W/(m2 sr) (emitter)
  float range;         ///< m; 0: infinite
  float coneScale;     ///< spot: clamp(cosine x scale + offset, 0, 1) squared
  float coneOffset;
  float highlight;  ///< 1: glossy receivers show it, 0: they do not
  float twoSided;   ///< 1: an emitter shines to both sides
};

/// A receiver of light: a vertex that is lit.
struct OccluderReceiverPoint {
  float position[3];  ///< scene coordinates
  float roughness;
  float normal[3];  ///< unit
  float pad0;
  float f0[3];  ///< reflectance at normal incidence; 0: diffuse only
  float pad1;
};

/// Light that leaves a vertex towards the eye; `diffuse` is yet to be multiplied by the albedo.
struct LitVertex {
  float diffuse[3];   ///< to be multiplied by the albedo
  float highlight;    ///< share of the lights' specular reflection that shadows leave
  float specular[3];  ///< specular reflection of the lights, with shadows
  float pad0;
  float reflected[3];  ///< specular reflection of occluders that mirror the lights
  float pad1;
};

#define PRELIGHT_STORES_TRANSMISSIVE 1
#define PRELIGHT_STORES_CAUSTIC 2
#define PRELIGHT_STORES_SPECULAR 4

/// Parameters of the lighting (OccluderShading), and the shape of the records.
struct OccluderTerms {
  int stored;  ///< PRELIGHT_STORES_...
  int stride;  ///< vec4 of a prepared record
  int lightCount;
  int thesisFormula;  ///< 1: Eq. 7.2 and 7.3, 0: soft
  int thesisMirrors;  ///< 1: mirroring occluders as in listing A.2, 0: energy-conserving lobes
  int orenNayar;      ///< 1: rough diffuse receivers
  float shadowStrength;
  float causticStrength;
  float bleeding;
  float diffuseFromSpecular;
  float specularFromSpecular;
  float specularExponent;
  float waves;       ///< amplitude of the deflection of directions, as its tangent
  float waveNumber;  ///< 1/m
  float moment;      ///< position in the period of all effects, [0,1)
  float fire;        ///< amplitude of the flicker
  float eyeIsPoint;  ///< 1: eye is a position, 0: it is the unit direction to the eye
  float eyeX;        ///< scene coordinates
  float eyeY;
  float eyeZ;
  float normalWaves;  ///< amplitude of the deflection of receivers' normals, as its tangent
};

#ifdef __cplusplus
}
#endif

#endif
