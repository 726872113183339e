#pragma once

#include <optional>
#include <vector>

#include "prelight/scene.h"
#include "prelight/shading.h"
#include "viewer/core/debug_options.h"
#include "viewer/core/layer_factors.h"
#include "viewer/core/occlusion_options.h"
#include "viewer/core/shading.h"

namespace prelight::viewer {

using prelight::AoCorrection;
using prelight::AoFilter;
using prelight::Lobe;
using prelight::ShadingOptions;

/// Options of a picture.
struct RenderOptions : ShadingOptions {
  Shading shading = Shading::Phong;
  int width = 0;              ///< pixels; 0: from the height and the camera's aspect (16:9 when it has none)
  int height = 720;           ///< pixels, 1..32768
  std::optional<int> camera;  ///< into Scene::cameras; none: the first, or one that frames the scene
  double skyRotation = 0.0;   ///< radians, turns the sky counter-clockwise about +Y seen from above
  std::optional<std::vector<Light>> lights;  ///< replaces the scene's punctual lights
  bool emitters = true;                      ///< emissive triangles light the scene
  Lobe lobe = Lobe::Ggx;                     ///< of glossy shading, and of lights in Phong's
  std::vector<GroupFactor> groups;           ///< of lights shading; those not named shine as in the file
  LayerFactors layers = wholePicture;        ///< of the picture's parts
  bool layersOfFrames = false;               ///< sequences have the layers of each picture
  DebugOptions debug;                        ///< view in place of the picture, or over it
  int samplesPerAxis = 2;                    ///< supersampling: this squared per pixel, box filtered; 1..8
};

}  // namespace prelight::viewer
