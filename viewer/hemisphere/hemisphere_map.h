#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace prelight::viewer {

/// How what lies above a receiver is projected to squares of texels.
enum class HemisphereMap : int {
  Stereographic,  ///< one disc: (x, y) / (1 + z) of directions (Staniszewski 2005, 2.2.2), which is also
                  ///< where a paraboloid mirror shows them (Heidrich and Seidel 1998)
  Orthographic,   ///< one disc: (x, y) of directions, as Staniszewski's Listing 2.4 is printed
  HemiPlane,      ///< one plane, which misses a seventh of the light (Larsen 2004, 11.1)
  Hemicube,       ///< five planes (Cohen and Greenberg 1985; Larsen 2004, 5.2)
  Tetrahedron,    ///< three sides of one that stands on its fourth (Larsen 2004, 5.2.1)
};
constexpr std::array<const char*, 5> hemisphereMapNames = {"stereographic", "orthographic", "hemi-plane",
                                                           "hemicube", "tetrahedron"};

/// Returns whether a map is a disc, in which straight edges of triangles are arcs.
constexpr bool isDisc(HemisphereMap map) {
  return map == HemisphereMap::Stereographic || map == HemisphereMap::Orthographic;
}

/// How a hemi-plane replaces the light that passes beside it.
enum class LostLight : int {
  Dark,  ///< nothing: as much is missing as shareBeside() of the brightest light tells
  Mean,  ///< the mean of what it sees (Larsen 2004, 11.1)
  Rim,   ///< what lies at its rim in the same azimuth
};
constexpr std::array<const char*, 3> lostLightNames = {"dark", "mean", "rim"};

struct HemiPlane {
  double halfWidth = 2.25;  ///< at distance 1, > 0
  LostLight lost = LostLight::Rim;
};

/// Share of an even sky's light that passes beside a hemi-plane: 1 less a square's form factor.
double shareBeside(const HemiPlane& plane);

/// A picture of a map.
struct HemisphereFace {
  glm::dmat3 frame{1.0};   ///< columns: right, up and forward in the receiver's frame, whose z is its normal
  glm::dvec4 window{0.0};  ///< left, right, bottom, top, of the plane at distance 1 or of the disc
};

std::vector<HemisphereFace> facesOf(HemisphereMap map, const HemiPlane& plane = {});

/// The solid angle that a texel represents.
struct HemisphereTexel {
  glm::dvec3 direction{0.0};  ///< unit, of its middle, in the receiver's frame
  double solidAngle = 0.0;    ///< sr; 0 where another face has the direction, and below the horizon
  glm::dvec3 beside{0.0};     ///< unit, of the mean of what passes beside a hemi-plane here
  double shareBeside = 0.0;   ///< of an even sky's light; 0 but along the rim of a hemi-plane
};

/// [face][y][x] of side x side texels, from the lower left.
std::vector<HemisphereTexel> texelsOf(HemisphereMap map, int side, const HemiPlane& plane = {});

/// Share of an even sky's light that falls on a map's texels: 1 but for rounding to texels, less of the
/// hemi-plane.
double coverageOf(const std::vector<HemisphereTexel>& texels);

}  // namespace prelight::viewer
