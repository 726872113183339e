#version 410 core
// Shows a supersampled picture of linear radiance: box filter, then the display transform of host/include/prelight/picture.h.
uniform sampler2D picture;
uniform int samplesPerAxis;
uniform float exposure;

out vec4 outColor;

// Khronos, "PBR Neutral tone mapper", specification 1.0, 2024.
vec3 pbrNeutral(vec3 color) {
  const float startCompression = 0.8 - 0.04;
  float least = min(color.r, min(color.g, color.b));
  color -= least < 0.08 ? least - 6.25 * least * least : 0.04;
  float peak = max(color.r, max(color.g, color.b));
  if (peak < startCompression) return color;
  const float headroom = 1.0 - startCompression;
  float newPeak = 1.0 - headroom * headroom / (peak + headroom - startCompression);
  float grey = 1.0 - 1.0 / (0.15 * (peak - newPeak) + 1.0);
  return mix(color * newPeak / peak, vec3(newPeak), grey);
}

vec3 encodeSrgb(vec3 v) {
  return mix(12.92 * v, 1.055 * pow(max(v, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, greaterThan(v, vec3(0.0031308)));
}

void main() {
  ivec2 corner = ivec2(gl_FragCoord.xy) * samplesPerAxis;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < samplesPerAxis; ++y) {
    for (int x = 0; x < samplesPerAxis; ++x) sum += texelFetch(picture, corner + ivec2(x, y), 0).rgb;
  }
  vec3 color = clamp(exposure * (sum / float(samplesPerAxis * samplesPerAxis)), vec3(0.0), vec3(1e6));
  outColor = vec4(encodeSrgb(clamp(pbrNeutral(color), 0.0, 1.0)), 1.0);
}
