// The lights' numbers; mirrored by LightBlock of uniform_blocks.h.
struct Light {
  vec4 positionKind;    // w: LightKind
  vec4 directionArea;   // xyz: way of the light, emitter's normal or profile's pole; w: emitter's area, half the angle of a directional light's disk, or squared least distance
  vec4 intensityRange;  // w: range, 0 infinite
  vec4 cone;            // x, y: scale and offset of the spot, or the profile's start and entry of the tables; z: 1 far: outside the scene, 2 and more: its shadow; w: 1 two-sided emitter, or a lamp of a sky; radius of what shines from a place without a shape
};

layout(std140) uniform Lights { Light lights[240]; };

const int kindDirectional = 0;
const int kindPoint = 1;
const int kindSpot = 2;
const int kindEmitter = 3;
const int kindProfiled = 4;
const int kindArea = 5;
const int kindCookie = 6;
