// What a program is compiled for: the text of viewer/shader_variant.h takes the place of this file, which names the
// constants for a surface that may have anything.
const int ambientRule = 0;     // Ambient of techniques.h
const int reflectionRule = 0;  // Reflection
const int throughRule = 0;     // Through
const int lampCount = -1;      // lights that are not samples where they are few, else -1: as many as counts tells
const bool interreflection = true;  // in AO
const bool hasBaseColorTexture = true;
const bool hasMetallicRoughnessTexture = true;
const bool hasEmissiveTexture = true;
const bool hasNormalTexture = true;
const bool hasEmission = true;
const bool hasCutouts = true;
const bool hasBlending = true;
const bool hasUnlit = true;
const bool hasTranslucency = true;
const bool hasGloss = true;
const bool hasGlass = true;
const bool hasLayer = true;
const bool hasSurroundings = true;
const bool hasVertexColors = true;
const bool hasCharts = true;
const bool hasCaustics = true;
const bool hasSkyMap = true;
const bool hasDirectionalLights = true;
const bool hasPointLights = true;
const bool hasSpotLights = true;
const bool hasEmitterLights = true;
