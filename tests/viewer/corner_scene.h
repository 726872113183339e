#pragma once

#include <glm/glm.hpp>

#include "viewer/quad_scene.h"
#include "viewer/screen/occlusion_options.h"

/// What occlusion that is found while drawing is tested with.
namespace prelight::test {

/// Screen shading of one sample a pixel.
viewer::RenderOptions screenOptions(int size, const viewer::ScreenOcclusionOptions& occlusion);

viewer::ScreenOcclusionOptions within(double radius,
                                      viewer::OcclusionMethod method = viewer::OcclusionMethod::Gtao);

/// A floor z = 0 and a wall x = 0 that it ends at, both wide, white and under a sky of radiance 1, `scale`
/// times as large and seen from as far.
QuadScene cornerScene(const Material& wall = lambertian(glm::vec3(1)), double scale = 1.0,
                      double half = 20.0);

/// The same of planes that are not cut into too many elements.
QuadScene smallCorner();

/// What of the sky a point of the floor sees past a wall without end at a distance, within a radius: its
/// directions in the unit disc that lie beyond distance / radius are blocked.
double openBeforeWall(double distance, double radius);

/// Where a picture by the first camera shows a point.
glm::vec3 pixelOf(const Picture& picture, const QuadScene& quad, const glm::dvec3& point);

/// A card over a floor, both two-sided, seen from above.
QuadScene cardOverFloor();

}  // namespace prelight::test
