// The light of an open sky. A technique's own text takes the place of this one (Ambient in host/techniques/drawing_rules.h) and
// answers what surface.frag asks about the light around a place:
// - opennessHere() and visibilityHere(): what is known of the place;
// - lampShadow(), lampVisibility(): shares of a lamp's light that arrive;
// - skyVisibility(), radianceFrom(): the sky's share and the radiance that arrive in a lobe;
// - hiddenHere(): mean radiance of what hides the sky, times its share;
// - radianceBehind(): what comes through glass;
// - ambientRadiance(): the light that arrives from everywhere, scattered by the surface's body;
// - passageHere(): the share of light that passes through the body, in a text that defines KNOWS_PASSAGE;
// - isSender, and shadowsSamples: whether lampVisibility() knows of samples of emissive surfaces.
#include "accessible_sky.glsl"
#include "plain_openness.glsl"
#include "plain_visibility.glsl"

vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  return radianceUnderSky(body, bumped, open, open.accessibility, ambientAround(bumped));
}
