#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "prelight/scene.h"
#include "viewer/core/layer_factors.h"
#include "viewer/core/render_options.h"

namespace prelight::viewer {

/// A rectangle of a picture, in pixels from its top left corner.
struct Tile {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The state of a picture that may differ from the next picture of the same scene.
struct View : ShadingOptions {
  Camera camera;
  int width = 0;  ///< pixels of the whole picture
  int height = 0;
  Shading shading = Shading::Phong;
  double skyRotation = 0.0;  ///< radians about +Y
  std::vector<Light> lights;
  bool emitters = true;
  LayerFactors layers = wholePicture;
  std::vector<glm::vec3> groupFactors;  ///< [light group]
  bool hidesProbes = false;             ///< where there are some
  DebugOptions debug;
  bool draft = false;  ///< while something moves: fewer samples of large lights
  /// Shifts of the nodes of PosedScene, m. The renderer learns of these and of the moment by sceneMoved().
  std::vector<glm::dvec3> nodeShifts;
  std::optional<SceneMoment> moment;  ///< none: as the scene was given
};

}  // namespace prelight::viewer
