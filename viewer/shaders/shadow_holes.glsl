// Holes of surfaces that stand in a light's way.
uniform vec4 alpha;  // factor, cutoff (< 0: opaque), 1: blended
uniform sampler2D baseColorTexture;

in vec2 vTexCoord;
in float vAlpha;

// Thresholds from 0 to 1 that differ from those around them (Jimenez 2014, interleaved gradient noise): of a blended surface
// as many texels are there as its alpha says.
float thresholdOfTexel() { return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))); }

bool isHole() {
  if (alpha.y < 0.0) return false;
  return alpha.x * vAlpha * texture(baseColorTexture, vTexCoord).a < (alpha.z > 0.5 ? thresholdOfTexel() : alpha.y);
}
