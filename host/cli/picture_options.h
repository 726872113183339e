#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "cli/bake_options.h"
#include "cli/drawn_caustics.h"
#include "cli/drawn_global_illumination.h"
#include "cli/picture_sky.h"
#include "cli/pose_options.h"
#include "cli/session.h"
#include "cli/values.h"
#include "cli/virtual_light_options.h"
#include "cli/volume_objects.h"
#include "encodings/encoding.h"
#include "gi/global_illumination.h"
#include "integrators/global_illumination_renderer.h"
#include "prelight/device.h"
#include "prelight/picture.h"
#include "viewer/posed_scene.h"
#include "viewer/render.h"

namespace prelight::cli {

/// What render and view take: a scene, how to light and shade it, and how to bake what the file does not
/// carry.
struct PictureOptions {
  std::filesystem::path scene;
  std::filesystem::path environment;
  std::optional<viewer::Shading> shading;
  const Encoding* encoding = nullptr;  ///< of what light maps or vertices hold; nullptr: irradiance
  GlobalIlluminationPictureRequest globalIllumination;  ///< what `--shading full` asks for
  std::optional<int> camera;
  PictureSize size;
  double skyRotationDegrees = 0.0;
  ExposureOption exposure;
  std::optional<std::vector<Light>> lights;
  std::vector<viewer::GroupFactor> groups;
  std::size_t haarTerms = 0;
  viewer::OccluderOptions occluders;
  viewer::ScreenOcclusionOptions screenOcclusion;
  VirtualLightOptions virtualLights;
  viewer::AoCorrection aoCorrection = viewer::AoCorrection::None;
  viewer::AoFilter aoFilter = viewer::AoFilter::Cone;
  double horizonSoftness = viewer::defaultHorizonSoftness;  ///< radians
  viewer::Lobe lobe = viewer::Lobe::Ggx;
  std::uint64_t causticPhotons = 0;  ///< of what OpenGL draws; 0: no caustics
  double thinBeyond = 0.0;           ///< m: LiveLightOptions' of a window
  LoadOptions load;                  ///< scene and variant
  PoseOptions pose;
  VolumeObjectOptions inVolume;
  BakeOptions bake;
};

void addPictureOptions(CLI::App& app, PictureOptions& options);

/// A scene ready to be drawn.
struct ShadedScene {
  LoadedScene loaded;
  Bake bake;           ///< what the file carries and what was baked for the shading
  BakedMotion motion;  ///< of a scene that is posed
  std::optional<Environment> environment;
  bool studio = false;  ///< `environment` is the built-in one
  viewer::RenderOptions render;
  std::optional<BakeRun> run;    ///< when something was baked
  BakeRequest request;           ///< of `run`
  std::optional<Device> device;  ///< relights what a shader does not
  std::unique_ptr<DrawnCaustics> caustics;
  std::optional<GlobalIllumination> globalIllumination;
  const Encoding* encoding = nullptr;                     ///< that is drawn
  std::unique_ptr<VolumeObjects> objects;                 ///< and probes, in `loaded` and `bake`
  std::unique_ptr<FollowingLight> following;              ///< of a window that shows global illumination
  std::unique_ptr<FollowingVirtualLights> virtualLights;  ///< of instant shading

  viewer::RenderInputs inputs() const;
  /// What other poses need; refers to both.
  viewer::PoseSources poseSources(const PoseOptions& pose) const;
};

/// Loads, checks the options against the scene and bakes what the shading needs and the file does not carry,
/// saying so. `checkOutputs` runs after the input was read and before anything is baked. With `everyShading`
/// a bake also makes what ao and sh need and what else the options name, so that shadings can be switched.
ShadedScene prepareScene(Session& session, const PictureOptions& options, bool everyShading,
                         const std::function<void()>& checkOutputs);

/// What reports of drawn pictures have in common: of one, and of several.
nlohmann::ordered_json drawnReport(Session& session, const PictureOptions& options,
                                   const std::filesystem::path& output, const ShadedScene& shaded,
                                   const Warnings& notes);

/// Reads the bake that a file carries; an empty one when it carries none.
Bake carriedBake(Session& session, const LoadedScene& loaded);

}  // namespace prelight::cli
