#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/scene.h"
#include "viewer/render.h"

namespace prelight::viewer {

/// A rectangle of a picture, in pixels from its top left corner.
struct Tile {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// What may change from one picture of a scene to the next.
struct View {
  Camera camera;
  int width = 0;  ///< pixels of the whole picture
  int height = 0;
  Shading shading = Shading::Phong;
  double skyRotation = 0.0;  ///< radians about +Y
  std::vector<Light> lights;
  bool emitters = true;
  bool windowLights = true;
  std::size_t haarTerms = 0;
  OccluderOptions occluders;
  AoCorrection aoCorrection = AoCorrection::None;
  ScreenOcclusionOptions screenOcclusion;
  std::vector<glm::vec3> groupFactors;  ///< [light group]
  bool draft = false;                   ///< while something moves: fewer samples of large lights
  std::vector<glm::dvec3> nodeShifts;   ///< m, of MovedScene; the renderer knows them by sceneMoved()
};

}  // namespace prelight::viewer
