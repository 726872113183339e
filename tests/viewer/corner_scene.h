#pragma once

#include <glm/glm.hpp>

#include "viewer/core/occlusion_options.h"
#include "viewer/quad_scene.h"

/// Scenes and options for tests of screen-space occlusion.
namespace prelight::test {

/// Options of screen shading with one sample per pixel.
viewer::RenderOptions screenOptions(int size, const viewer::ScreenOcclusionOptions& occlusion);

viewer::ScreenOcclusionOptions within(double radius,
                                      viewer::OcclusionMethod method = viewer::OcclusionMethod::Gtao);

/// A floor z = 0 that ends at a wall x = 0, both wide and white, under a sky of radiance 1. Scene and camera
/// distance are multiplied by `scale`.
QuadScene cornerScene(const Material& wall = lambertian(glm::vec3(1)), double scale = 1.0,
                      double half = 20.0);

/// The corner from smaller planes, which give fewer elements.
QuadScene smallCorner();

/// Open share of the sky at a point of the floor at `distance` from an endless wall, with occlusion limited
/// to `radius`: directions whose projection to the unit disc lies beyond distance / radius are blocked.
double openBeforeWall(double distance, double radius);

/// The pixel at which the first camera sees `point`.
glm::vec3 pixelOf(const Picture& picture, const QuadScene& quad, const glm::dvec3& point);

/// A card above a floor, both two-sided, seen from above.
QuadScene cardOverFloor();

}  // namespace prelight::test
