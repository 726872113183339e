#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "prelight/picture.h"
#include "prelight/scene.h"
#include "relight/vertex_lights.h"
#include "viewer/caustic_pass.h"
#include "viewer/group_option.h"
#include "viewer/illumination.h"
#include "viewer/screen/occlusion_options.h"
#include "viewer/shading.h"
#include "viewer/specular_lobes.h"

namespace prelight {
class Device;
struct Encoding;
struct GlobalIllumination;
struct VirtualLightSet;
}  // namespace prelight

namespace prelight::viewer {

/// Balls that show what a volume holds (host/relight/object_light.h).
struct DrawnProbes {
  int node = 0;               ///< that they are
  std::uint32_t surface = 0;  ///< material that is theirs alone
};

/// What is drawn. The referents outlive the call (or the window).
struct RenderInputs {
  const Scene& scene;
  const CompiledScene& compiled;  ///< of `scene`
  const Bake* bake = nullptr;     ///< of `compiled`; nullptr: none, enough for Phong
  const Environment* environment =
      nullptr;                         ///< nullptr: no sky, or a neutral one when nothing else gives light
  const Device* device = nullptr;      ///< relights wavelet and glossy transfer; nullptr: the host does
  const Caustics* caustics = nullptr;  ///< light of these photons is added to every shading; nullptr: none
  const GlobalIllumination* globalIllumination =
      nullptr;  ///< Shading::GlobalIllumination needs it, and adds its caustics; nullptr: not offered
  /// Normal textures turn lights, reflections, and baked light that holds directions. False: surfaces are
  /// even.
  bool normalTextures = true;
  const Encoding* encoding =
      nullptr;  ///< lightmap and radiosity shading draw light in it, where the bake holds some; nullptr: none
  /// What it carries is drawn in place of the bake's, which is of another pose; nullptr: there is none.
  const Bake* posed = nullptr;

  std::optional<DrawnProbes> probes = {};          ///< none: the scene has no such balls
  const VirtualLightSet* virtualLights = nullptr;  ///< Shading::Instant needs it; nullptr: not offered
  /// Objects whose vertices have nothing baked but for direct light, lit by ObjectCubes.
  std::span<const VertexRange> cubeLit = {};
  /// [vertex of theirs], what they leave of an even light from all around, and reflect of it onto themselves;
  /// none: all of it.
  std::span<const glm::vec3> cubeOpenness = {};

  /// All of them with another bake, which is the pose's.
  RenderInputs with(const Bake* chosen) const {
    RenderInputs chosenInputs = *this;
    chosenInputs.bake = chosen;
    return chosenInputs;
  }

  /// All of them for a scene that stands otherwise.
  RenderInputs movedTo(const Scene& movedScene, const CompiledScene& moved) const {
    return {movedScene,     moved,    bake,  environment, device,        caustics, globalIllumination,
            normalTextures, encoding, posed, probes,      virtualLights, cubeLit,  cubeOpenness};
  }
};

/// Light that creases reflect into themselves, in ao and screen shading (Real-Time Rendering, 4th
/// edition, 11.3).
enum class AoCorrection {
  None,
  Interreflection,  ///< accessibility k becomes k / (1 - albedo (1 - k)), a channel (Eq. 11.13)
  Cubic,            ///< a cubic of k and the albedo, fitted to traced scenes (Jimenez et al. 2016)
};

/// Over what the sky is averaged for ambient occlusion whose bent normal is known (Real-Time Rendering, 4th
/// edition, 11.3.7).
enum class AoFilter {
  Cone,    ///< the cosine within the cone about the bent normal that lets through the accessibility
  Cosine,  ///< all of the cosine about the bent normal
};

constexpr double defaultHorizonSoftness = 0.035;  ///< 2 degrees

struct RenderOptions {
  Shading shading = Shading::Phong;
  int width = 0;              ///< pixels; 0: from the height and the camera's aspect (16:9 when it has none)
  int height = 720;           ///< pixels, 1..32768
  std::optional<int> camera;  ///< into Scene::cameras; none: the first, or frameCamera when there is none
  double skyRotation = 0.0;   ///< radians, turns the sky counter-clockwise about +Y seen from above
  std::optional<std::vector<Light>> lights;  ///< replaces the scene's punctual lights
  bool emitters = true;                      ///< emissive triangles light the scene
  bool windowLights = true;   ///< damps the SH bands of delta lights against ringing (see lighting.h)
  std::size_t haarTerms = 0;  ///< coefficients that a light keeps in wavelet shading; 0: all
  Lobe lobe = Lobe::Ggx;      ///< of glossy shading, and of lights in Phong's
  AoCorrection aoCorrection = AoCorrection::None;
  AoFilter aoFilter = AoFilter::Cone;
  double horizonSoftness = defaultHorizonSoftness;  ///< of horizons shading: angular radius of lamps
                                                    ///< without a size, radians; 0: hard shadows
  ScreenOcclusionOptions screenOcclusion;           ///< of screen shading
  OccluderOptions occluders;                        ///< of vo shading
  std::vector<GroupFactor> groups;  ///< of lights shading; those not named shine as in the file
  bool layersOfFrames = false;      ///< sequences have the layers of each picture
  int samplesPerAxis = 2;           ///< supersampling: this squared per pixel, box filtered; 1..8
};

/// Draws a picture of linear radiance, without a display or a window.
/// `notes` receives, once each, what the picture approximates or what was chosen for want of an input.
/// Throws UsageError (camera index, size), Error (no OpenGL, shading that the bake does not carry).
/// `plan` receives what global illumination draws beside the picture and what it leaves out, `layers` what
/// the picture is a sum of and how open surfaces are where the shading knows; nullptr: not wanted.
Picture renderPicture(const RenderInputs& inputs, const RenderOptions& options, Warnings& notes,
                      std::vector<PlannedPass>* plan = nullptr,
                      std::vector<PictureChannel>* layers = nullptr);

}  // namespace prelight::viewer
