#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "integrators/global_illumination_renderer.h"
#include "integrators/live_virtual_lights.h"
#include "pictures/pose.h"
#include "pictures/session/bake_settings.h"
#include "pictures/volume_objects.h"
#include "prelight/load.h"
#include "prelight/options.h"
#include "viewer/core/shading.h"
#include "viewer/frame/render.h"

namespace prelight {
struct Encoding;
}

namespace prelight::pictures {

/// A scene, how to light and shade it, and how to bake what the file does not carry.
struct PictureRequest {
  std::filesystem::path scene;
  LoadOptions load;                        ///< the file's scene and variant
  std::shared_ptr<const Environment> sky;  ///< map of the sky; nullptr: `environment`
  std::filesystem::path environment;  ///< file or built-in name of the sky; empty: chosen, see PictureSky
  std::optional<viewer::Shading> shading;  ///< none: the best that the file carries
  const Encoding* encoding = nullptr;      ///< of the light of texels or vertices; nullptr: irradiance
  std::optional<int> width;                ///< pixels; none: from the height and the camera's aspect
  int height = 720;                        ///< pixels
  viewer::RenderOptions render;  ///< how it is drawn; shading, size and sky are resolved by prepareScene()
  GlobalIlluminationPictureRequest full;  ///< options of full shading
  InstantOptions instant;                 ///< options of instant shading
  std::uint64_t causticPhotons = 0;       ///< of other shadings that OpenGL draws; 0: no caustics
  double thinBeyond = 0.0;                ///< m, of a window: LiveLightOptions::thinBeyond
  /// Light that follows a window does the same work in the frames of every run, whatever time it takes.
  bool countedFrames = false;
  PoseOptions pose;
  ObjectOptions objects;
  BakeSettings bake;
};

}  // namespace prelight::pictures

namespace prelight {

/// The options of a picture that belong to none of its parts.
template <>
std::span<const Option<pictures::PictureRequest>> optionsOf<pictures::PictureRequest>();

}  // namespace prelight
