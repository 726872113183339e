// The square between four texels of a light map that walls divide, and which of the four lie on a point's
// side of the walls. OpenCL C, GLSL and C++.
//
// Walls are known where they cross the square's edges (host/include/prelight/light_map.h,
// LightMapLayout::Wall): at a share from 0 to 1 of the edge from the left or from above, or at
// PRELIGHT_NO_WALL. Two crossings on opposite edges are joined by a straight wall. Two crossings on adjacent
// edges leave open whether the wall is straight or has a corner, and a single one leaves open how far the
// wall goes. In these cases there are two answers, and look-ups take the darker one.
#ifndef PRELIGHT_SHARED_WALLED_SQUARE_H
#define PRELIGHT_SHARED_WALLED_SQUARE_H

#ifdef __cplusplus
#define PRELIGHT_SQUARE_FUNCTION inline
namespace prelight::device {
#else
#define PRELIGHT_SQUARE_FUNCTION
#endif
#ifdef __OPENCL_C_VERSION__
typedef struct WalledSquare WalledSquare;
typedef struct SquareWeights SquareWeights;
#endif

#define PRELIGHT_NO_WALL 2.0f

// Distance from a wall, in texels, within which it is uncertain on which side a point lies.
#define PRELIGHT_WALL_SLACK 2e-3f

// Positions at which walls cross the edges of a square, as shares of the edges, or PRELIGHT_NO_WALL.
struct WalledSquare {
  float top;  ///< shares of edges
  float bottom;
  float left;
  float right;
};

// Weights of the four texels of a square.
struct SquareWeights {
  float leftTop;
  float rightTop;
  float leftBottom;
  float rightBottom;
};

PRELIGHT_SQUARE_FUNCTION bool crosses(float share) { return share <= 1.0f; }

PRELIGHT_SQUARE_FUNCTION bool hasWalls(WalledSquare w) {
  return crosses(w.top) || crosses(w.bottom) || crosses(w.left) || crosses(w.right);
}

PRELIGHT_SQUARE_FUNCTION SquareWeights squareWeights(float leftTop, float rightTop, float leftBottom,
                                                     float rightBottom) {
  SquareWeights w;
  w.leftTop = leftTop;
  w.rightTop = rightTop;
  w.leftBottom = leftBottom;
  w.rightBottom = rightBottom;
  return w;
}

// Returns where a wall that crosses one or both of two opposite edges lies at `along`, which is 0 on the
// first edge and 1 on the second.
PRELIGHT_SQUARE_FUNCTION float wallBetween(float first, float second, float along) {
  if (!crosses(first)) return second;
  return crosses(second) ? first + (second - first) * along : first;
}

// Returns true when a point is on the side of the one texel that two crossings on its edges cut off. dx, dy:
// the point relative to the texel; a, b: positions of the crossings along x and y.
PRELIGHT_SQUARE_FUNCTION bool cutOff(float dx, float dy, float a, float b, bool wide) {
  if (wide) return dx < a + PRELIGHT_WALL_SLACK && dy < b + PRELIGHT_WALL_SLACK;
  return dx * b + dy * a < a * b - PRELIGHT_WALL_SLACK;
}

// Returns the texels on a point's side where two crossings lie on adjacent edges.
PRELIGHT_SQUARE_FUNCTION SquareWeights sideOfCorner(WalledSquare w, float x, float y, bool wide) {
  bool top = crosses(w.top), left = crosses(w.left);
  float across = top ? w.top : w.bottom, down = left ? w.left : w.right;
  bool off = cutOff(left ? x : 1.0f - x, top ? y : 1.0f - y, left ? across : 1.0f - across,
                    top ? down : 1.0f - down, wide);
  float corner = off ? 1.0f : 0.0f, others = off ? 0.0f : 1.0f;
  return squareWeights(left && top ? corner : others, !left && top ? corner : others,
                       left && !top ? corner : others, !left && !top ? corner : others);
}

// Returns 1 for the texels that lie on the side of the point (x, y), otherwise 0. wide: chooses between the
// two answers.
PRELIGHT_SQUARE_FUNCTION SquareWeights texelsOnSide(WalledSquare w, float x, float y, bool wide) {
  bool top = crosses(w.top), bottom = crosses(w.bottom), left = crosses(w.left), right = crosses(w.right);
  float slack = wide ? PRELIGHT_WALL_SLACK : -PRELIGHT_WALL_SLACK;
  float l = x < wallBetween(w.top, w.bottom, y) + slack ? 1.0f : 0.0f;
  float u = y < wallBetween(w.left, w.right, x) + slack ? 1.0f : 0.0f;
  float r = 1.0f - l, d = 1.0f - u;
  if (top && bottom)
    return squareWeights(left ? l * u : l, right ? r * u : r, left ? l * d : l, right ? r * d : r);
  if (left && right)
    return squareWeights(top ? u * l : u, top ? u * r : u, bottom ? d * l : d, bottom ? d * r : d);
  if ((top || bottom) && (left || right)) return sideOfCorner(w, x, y, wide);
  if (wide && (top || bottom)) return squareWeights(l, r, l, r);
  if (wide && (left || right)) return squareWeights(u, u, d, d);
  return squareWeights(1.0f, 1.0f, 1.0f, 1.0f);
}

// Returns bilinear weights, of sum 1, of the texels on the point's side.
PRELIGHT_SQUARE_FUNCTION SquareWeights walledWeights(WalledSquare w, float x, float y, bool wide) {
  float least = 1e-6f;  // keeps the weights defined where the point is far from all of them
  SquareWeights side = texelsOnSide(w, x, y, wide);
  float a = side.leftTop * ((1.0f - x) * (1.0f - y) + least), b = side.rightTop * (x * (1.0f - y) + least);
  float c = side.leftBottom * ((1.0f - x) * y + least), d = side.rightBottom * (x * y + least);
  float whole = 1.0f / (a + b + c + d);
  return squareWeights(whole * a, whole * b, whole * c, whole * d);
}

#ifdef __cplusplus
}  // namespace prelight::device
#endif

#endif
