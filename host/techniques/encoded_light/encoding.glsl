// How the numbers of a place tell what arrives there: an encoding's own text (host/encodings) takes the place of this file
// where one is drawn.
const int encodedValueCount = 1;

// W/m2 for a unit normal; frame: columns tangent, bitangent and normal of the surface.
vec3 encodedIrradiance(float values[encodedValueCount], mat3 frame, vec3 normal) { return vec3(values[0]); }

// Lamps that the numbers tell of.
const int encodedLampCount = 0;

// Perpendicular irradiance of a lamp, W/m2, and the unit direction towards it.
vec3 encodedLamp(float values[encodedValueCount], mat3 frame, int i, out vec3 toLamp) {
  toLamp = frame[2];
  return vec3(0.0);
}

// Mean radiance, without the lamps, in a lobe of a spread (LobeAxis in lobe_axis.glsl) about a unit axis.
vec3 encodedRadiance(float values[encodedValueCount], mat3 frame, vec3 axis, float spread) { return vec3(values[0]) / pi; }
