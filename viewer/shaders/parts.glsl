// The parts that a picture is a sum of, drawn one by one: PicturePart of host/images/picture_parts.h; needs variant.glsl.
uniform int shownLayer;  // a part, or partAccessibility

const int partEmitted = 0;
const int partDirect = 1;
const int partIndirect = 2;
const int partCaustic = 3;
const int partReflected = 4;
const int partBaked = 5;
const int partAccessibility = 6;

// Radiance of a part where that is shown, or all are.
vec3 partShown(int part, vec3 radiance) { return !showsParts || shownLayer == part ? radiance : vec3(0.0); }

// The shown part of a sum whose direct part is known.
vec3 partsShown(vec3 sum, vec3 direct) {
  if (!showsParts) return sum;
  return shownLayer == partDirect ? direct : shownLayer == partIndirect ? sum - direct : vec3(0.0);
}
