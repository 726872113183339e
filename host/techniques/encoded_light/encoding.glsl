// How the numbers of a place tell what arrives there: an encoding's own text (host/encodings) takes the place of this file
// where one is drawn.
const int encodedValueCount = 1;

// W/m2 for a unit normal; frame: columns tangent, bitangent and normal of the surface.
vec3 encodedIrradiance(float values[encodedValueCount], mat3 frame, vec3 normal) { return vec3(values[0]); }
