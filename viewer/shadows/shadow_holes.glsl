// Holes of surfaces that stand in a light's way.
uniform vec4 alpha;  // factor, cutoff (< 0: opaque), 1: blended
uniform float passes;  // share of the light that goes straight through what is there
uniform sampler2D baseColorTexture;

in vec2 vTexCoord;
in float vAlpha;

// Thresholds from 0 to 1 that differ from those around them (Jimenez 2014, interleaved gradient noise): of a blended surface
// as many texels are there as its alpha says, of a pane as many as it keeps of the light.
float thresholdOfTexel() { return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))); }

bool isHole() {
  float covered = 1.0;
  if (alpha.y >= 0.0) {
    float there = alpha.x * vAlpha * texture(baseColorTexture, vTexCoord).a;
    if (alpha.z > 0.5)
      covered = there;
    else if (there < alpha.y)
      return true;
  }
  return covered * (1.0 - passes) < thresholdOfTexel();
}
