// The square between four texels of a light map that walls part: which of the four lie on a point's side. OpenCL C, GLSL and C++.
//
// Walls are known where they cross the square's edges (host/include/prelight/light_map.h, LightMapLayout::Wall): at a share from
// 0 to 1 of the edge from the left or from above, or at PRELIGHT_NO_WALL. Two crossings on opposite edges are joined by a
// straight wall. Two on edges that meet leave open whether the wall is straight or has a corner, and a single one how far
// the wall goes: so there are two answers, and whoever looks light up takes the darker one.
#ifndef PRELIGHT_GATHER_WALLED_SQUARE_FUNCS_CL
#define PRELIGHT_GATHER_WALLED_SQUARE_FUNCS_CL

#include "core/dialect.h"

#define PRELIGHT_NO_WALL 2.0f

// How far from a wall, in texels, it is uncertain on which side a point lies.
#define PRELIGHT_WALL_SLACK 2e-3f

struct WalledSquare {
  float top;  // shares of edges
  float bottom;
  float left;
  float right;
};
STRUCT_NAME(WalledSquare)

bool crosses(float share) { return share <= 1.0f; }

bool hasWalls(WalledSquare w) { return crosses(w.top) || crosses(w.bottom) || crosses(w.left) || crosses(w.right); }

// Where a wall that crosses one or both of two opposite edges lies at `along`, 0 on the first and 1 on the second.
float wallBetween(float first, float second, float along) {
  if (!crosses(first)) return second;
  return crosses(second) ? first + (second - first) * along : first;
}

// Whether a point is on the side of the one texel that two crossings on its edges cut off; dx, dy: from it; a, b: of the
// crossings along x and y.
bool cutOff(float dx, float dy, float a, float b, bool wide) {
  if (wide) return dx < a + PRELIGHT_WALL_SLACK && dy < b + PRELIGHT_WALL_SLACK;
  return dx * b + dy * a < a * b - PRELIGHT_WALL_SLACK;
}

// 1 for those of (left, top), (right, top), (left, bottom), (right, bottom) that lie on the side of the point (x, y). wide: the
// first answer, or the second.
vec4 cornersOnSide(WalledSquare w, float x, float y, bool wide) {
  bool top = crosses(w.top), bottom = crosses(w.bottom), left = crosses(w.left), right = crosses(w.right);
  float slack = wide ? PRELIGHT_WALL_SLACK : -PRELIGHT_WALL_SLACK;
  float l = x < wallBetween(w.top, w.bottom, y) + slack ? 1.0f : 0.0f;
  float u = y < wallBetween(w.left, w.right, x) + slack ? 1.0f : 0.0f;
  float r = 1.0f - l, d = 1.0f - u;
  if (top && bottom)
    return VEC4(left ? l * u : l, right ? r * u : r, left ? l * d : l, right ? r * d : r);
  if (left && right) return VEC4(top ? u * l : u, top ? u * r : u, bottom ? d * l : d, bottom ? d * r : d);
  if ((top || bottom) && (left || right)) {
    float acrossShare = top ? w.top : w.bottom, downShare = left ? w.left : w.right;
    bool off = cutOff(left ? x : 1.0f - x, top ? y : 1.0f - y, left ? acrossShare : 1.0f - acrossShare,
                      top ? downShare : 1.0f - downShare, wide);
    vec4 corner = VEC4(left && top ? 1.0f : 0.0f, right && top ? 1.0f : 0.0f, left && bottom ? 1.0f : 0.0f,
                       right && bottom ? 1.0f : 0.0f);
    return off ? corner : VEC4(1.0f) - corner;
  }
  if (!wide || !(top || bottom || left || right)) return VEC4(1.0f);
  return top || bottom ? VEC4(l, r, l, r) : VEC4(u, u, d, d);
}

// Bilinear weights of the four, of sum 1, of those on the point's side.
vec4 walledWeights(WalledSquare w, float x, float y, bool wide) {
  const float least = 1e-6f;  // where the point is far from all of them
  vec4 all = VEC4((1.0f - x) * (1.0f - y), x * (1.0f - y), (1.0f - x) * y, x * y) + VEC4(least);
  vec4 kept = all * cornersOnSide(w, x, y, wide);
  return kept / (kept.x + kept.y + kept.z + kept.w);
}

#endif
