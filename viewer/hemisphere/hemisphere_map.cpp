#include "viewer/hemisphere/hemisphere_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight::viewer {
namespace {

constexpr double sideElevation = 1.0 / 3.0;  ///< sine, of the normals of a tetrahedron's sides
constexpr int tetrahedronSides = 3;

/// Looking along `forward`, the receiver's normal upwards.
glm::dmat3 uprightFrame(const glm::dvec3& forward) {
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 0.0, 1.0)));
  return {right, glm::cross(right, forward), forward};
}

std::vector<HemisphereFace> hemicubeFaces() {
  std::vector<HemisphereFace> faces = {{glm::dmat3(1.0), {-1.0, 1.0, -1.0, 1.0}}};
  for (const glm::dvec3& forward :
       {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0)})
    faces.push_back({uprightFrame(forward), {-1.0, 1.0, 0.0, 1.0}});
  return faces;
}

glm::dvec3 tetrahedronNormal(int side) {
  const double angle = 2.0 * std::numbers::pi / tetrahedronSides * side;
  const double out = std::sqrt(1.0 - sideElevation * sideElevation);
  return {out * std::cos(angle), out * std::sin(angle), sideElevation};
}

/// Windows from the horizon, 60 degrees to each side, to the zenith.
std::vector<HemisphereFace> tetrahedronFaces() {
  const double out = std::sqrt(1.0 - sideElevation * sideElevation);
  const double corner = 0.5 * out;  // of the horizon's corner along the normal
  const double width = std::sqrt(0.75) / corner, below = -0.5 * sideElevation / corner;
  std::vector<HemisphereFace> faces;
  for (int side = 0; side < tetrahedronSides; ++side)
    faces.push_back({uprightFrame(tetrahedronNormal(side)), {-width, width, below, out / sideElevation}});
  return faces;
}

/// Whether a direction is another side's.
bool isElsewhere(HemisphereMap map, std::size_t face, const glm::dvec3& direction) {
  if (direction.z <= 0.0) return true;
  if (map != HemisphereMap::Tetrahedron) return false;
  for (int side = 0; side < tetrahedronSides; ++side)
    if (glm::dot(direction, tetrahedronNormal(side)) >
        glm::dot(direction, tetrahedronNormal(static_cast<int>(face))) + 1e-12)
      return true;
  return false;
}

/// Solid angle of the rectangle between the axes and (x, y) in a plane at distance 1.
double angleTo(double x, double y) { return std::atan2(x * y, std::sqrt(1.0 + x * x + y * y)); }

HemisphereTexel planeTexel(const HemisphereFace& face, const glm::dvec2& low, const glm::dvec2& high) {
  HemisphereTexel texel;
  texel.direction = face.frame * glm::normalize(glm::dvec3(0.5 * (low + high), 1.0));
  texel.solidAngle =
      angleTo(high.x, high.y) - angleTo(low.x, high.y) - angleTo(high.x, low.y) + angleTo(low.x, low.y);
  return texel;
}

/// Texels outside of the orthographic disc have no direction; they get one below the horizon.
HemisphereTexel orthographicTexel(const glm::dvec2& low, const glm::dvec2& high) {
  const glm::dvec2 p = 0.5 * (low + high);
  const double r2 = glm::dot(p, p);
  if (r2 >= 1.0) return {{0.0, 0.0, -1.0}};
  const double cosine = std::sqrt(1.0 - r2);
  return {{p, cosine}, (high.x - low.x) * (high.y - low.y) / cosine};
}

HemisphereTexel stereographicTexel(const glm::dvec2& low, const glm::dvec2& high) {
  const glm::dvec2 p = 0.5 * (low + high);
  const double r2 = glm::dot(p, p), scale = 2.0 / (1.0 + r2);
  return {{scale * p, (1.0 - r2) / (1.0 + r2)}, scale * scale * (high.x - low.x) * (high.y - low.y)};
}

HemisphereTexel texelOf(HemisphereMap map, const HemisphereFace& face, const glm::dvec2& low,
                        const glm::dvec2& high) {
  switch (map) {
    case HemisphereMap::Stereographic:
      return stereographicTexel(low, high);
    case HemisphereMap::Orthographic:
      return orthographicTexel(low, high);
    default:
      return planeTexel(face, low, high);
  }
}

/// Share of an even sky's light that passes beside one side of a hemi-plane between the middle of the side
/// and `along` it: the integral of cos^2 / 2 pi of the angle at which the side is seen, over the azimuth.
double shareBesideSide(double halfWidth, double along) {
  const double diagonal = std::sqrt(1.0 + halfWidth * halfWidth);
  return 0.5 * std::numbers::inv_pi *
         (std::atan(along / halfWidth) - halfWidth / diagonal * std::atan(along / diagonal));
}

/// Adds the share of light that passes beside a plane to the texels of its rim.
void addRim(double halfWidth, int side, std::vector<HemisphereTexel>& texels) {
  const double step = 2.0 * halfWidth / side;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto part = [&](int across, int along) {
        if (across > 0 && across < side - 1) return glm::dvec2(0.0);  // share, azimuth
        const double low = along * step - halfWidth, high = low + step;
        return glm::dvec2(shareBesideSide(halfWidth, high) - shareBesideSide(halfWidth, low),
                          std::atan(high / halfWidth) - std::atan(low / halfWidth));
      };
      const glm::dvec2 both = part(x, y) + part(y, x);
      if (both.x <= 0.0) continue;
      HemisphereTexel& texel = texels[static_cast<std::size_t>(y * side + x)];
      texel.shareBeside = both.x;
      // The mean of the cosine, weighted by itself, below the rim's.
      const double cosine = 2.0 / 3.0 * std::sqrt(2.0 * std::numbers::pi * both.x / both.y);
      const glm::dvec2 away = glm::normalize(glm::dvec2(texel.direction));
      texel.beside = {std::sqrt(1.0 - cosine * cosine) * away, cosine};
    }
}

}  // namespace

double shareBeside(const HemiPlane& plane) { return 8.0 * shareBesideSide(plane.halfWidth, plane.halfWidth); }

std::vector<HemisphereFace> facesOf(HemisphereMap map, const HemiPlane& plane) {
  switch (map) {
    case HemisphereMap::Stereographic:
    case HemisphereMap::Orthographic:
      return {{glm::dmat3(1.0), {-1.0, 1.0, -1.0, 1.0}}};
    case HemisphereMap::HemiPlane:
      return {{glm::dmat3(1.0), plane.halfWidth * glm::dvec4(-1.0, 1.0, -1.0, 1.0)}};
    case HemisphereMap::Hemicube:
      return hemicubeFaces();
    case HemisphereMap::Tetrahedron:
      break;
  }
  return tetrahedronFaces();
}

std::vector<HemisphereTexel> texelsOf(HemisphereMap map, int side, const HemiPlane& plane) {
  std::vector<HemisphereTexel> texels;
  const std::vector<HemisphereFace> faces = facesOf(map, plane);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const glm::dvec4& window = faces[f].window;
    const glm::dvec2 corner(window.x, window.z),
        step = glm::dvec2(window.y - window.x, window.w - window.z) / double(side);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const glm::dvec2 low = corner + step * glm::dvec2(x, y), high = low + step;
        HemisphereTexel texel = texelOf(map, faces[f], low, high);
        if (isElsewhere(map, f, texel.direction)) texel.solidAngle = 0.0;
        texels.push_back(texel);
      }
  }
  if (map == HemisphereMap::HemiPlane) addRim(plane.halfWidth, side, texels);
  return texels;
}

double coverageOf(const std::vector<HemisphereTexel>& texels) {
  double sum = 0.0;
  for (const HemisphereTexel& texel : texels)
    sum += std::max(texel.direction.z, 0.0) * texel.solidAngle * std::numbers::inv_pi;
  return sum;
}

}  // namespace prelight::viewer
