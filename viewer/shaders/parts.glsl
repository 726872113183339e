// The parts that a picture is a sum of, with a factor each: PicturePart of host/images/picture_parts.h; needs variant.glsl.
uniform float partFactors[7];  // of the last: above 0 where accessibility is shown in place of light

const int partEmitted = 0;
const int partDirect = 1;
const int partIndirect = 2;
const int partCaustic = 3;
const int partReflected = 4;
const int partBaked = 5;
const int partAccessibility = 6;

// Radiance of a part as it is shown.
vec3 partShown(int part, vec3 radiance) { return showsParts ? partFactors[part] * radiance : radiance; }

// A sum of direct and indirect light whose direct part is known, as it is shown.
vec3 partsShown(vec3 sum, vec3 direct) {
  return showsParts ? partFactors[partDirect] * direct + partFactors[partIndirect] * (sum - direct) : sum;
}

bool showsAccessibility() { return showsParts && partFactors[partAccessibility] > 0.0; }
