// Holes of surfaces that stand in a light's way.
uniform vec4 alpha;  // factor, cutoff (< 0: opaque)
uniform sampler2D baseColorTexture;

in vec2 vTexCoord;
in float vAlpha;

bool isHole() { return alpha.y >= 0.0 && alpha.x * vAlpha * texture(baseColorTexture, vTexCoord).a < alpha.y; }
