#version 410 core
// Brings a picture of linear radiance to another size: box filter to fewer pixels, linear interpolation to more.
uniform sampler2D picture;
uniform int samplesPerAxis;    // of a pixel; 1 where the picture has fewer
uniform vec2 samplesPerPixel;  // along each axis

out vec4 outColor;

vec3 meanHere() {
  ivec2 corner = ivec2(gl_FragCoord.xy) * samplesPerAxis;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < samplesPerAxis; ++y) {
    for (int x = 0; x < samplesPerAxis; ++x) sum += texelFetch(picture, corner + ivec2(x, y), 0).rgb;
  }
  return sum / float(samplesPerAxis * samplesPerAxis);
}

vec3 at(ivec2 texel) { return texelFetch(picture, clamp(texel, ivec2(0), textureSize(picture, 0) - 1), 0).rgb; }

vec3 betweenSamples() {
  vec2 place = gl_FragCoord.xy * samplesPerPixel - 0.5;
  ivec2 corner = ivec2(floor(place));
  vec2 share = place - vec2(corner);
  return mix(mix(at(corner), at(corner + ivec2(1, 0)), share.x), mix(at(corner + ivec2(0, 1)), at(corner + ivec2(1, 1)), share.x), share.y);
}

void main() { outColor = vec4(samplesPerPixel.x < 1.0 ? betweenSamples() : meanHere(), 1.0); }
