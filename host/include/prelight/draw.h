#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/bake.h"
#include "prelight/error.h"
#include "prelight/picture.h"
#include "prelight/plan.h"
#include "prelight/scene.h"
#include "prelight/shading.h"
#include "prelight/techniques.h"

/// Pictures of baked scenes, drawn by OpenGL without a display, or traced in full shading. These functions
/// lie in a library of their own, prelight::pictures, which is built and installed with the viewer.

namespace prelight {

class Device;
class Progress;
struct LoadedScene;

/// Returns a maker of renderers for BakeOptions::hemispheres that draw by OpenGL, without a display; makers
/// throw Error (NoDevice) where there is none. Empty in a build without the viewer.
HemisphereRendererMaker openGlHemispheres();

/// A glTF file that is put into a scene.
struct PlacedObject {
  std::filesystem::path file;
  glm::dvec3 at{0.0};       ///< m, position of the file's origin in world space
  double yawDegrees = 0.0;  ///< counter-clockwise as seen from above
  double scale = 1.0;       ///< > 0
};

/// The source of light for objects that were not baked with a scene.
enum class ObjectLighting : std::uint8_t {
  Auto,    ///< the bake's volume where there is one, else cube maps
  Volume,  ///< the bake's volume
  Cube,    ///< cube maps of the lit scene, drawn where the objects stand
};

/// The method that computes the shadows of objects on a scene.
enum class ObjectShadows : std::uint8_t {
  Rays,           ///< rays to objects and to lamps
  Occluders,      ///< the objects as vector occluders, blurred but in a fraction of the time
  Neighbourhood,  ///< matrices of transfer around the objects
};

/// The objects and probes that are added to a scene, and their light. Phong, sh and lights shading have them.
struct ObjectOptions {
  std::vector<PlacedObject> objects = {};
  bool probes = false;  ///< draws a ball in every cell of the bake's volume that is not inside an object
  ObjectLighting lighting = ObjectLighting::Auto;
  ObjectShadows shadows = ObjectShadows::Rays;

  bool any() const { return probes || !objects.empty(); }
};

/// A displacement of nodes from their places in the file.
struct NodeMove {
  std::string pattern;      ///< matches names of mesh nodes
  glm::dvec3 by{0.0};       ///< m, world space
  double yawDegrees = 0.0;  ///< counter-clockwise as seen from above, about the node's origin
};

/// The differences between the scene that is drawn and the scene as it was loaded.
struct Pose {
  std::optional<double> at = {};     ///< seconds of an animation; none: as it was loaded
  std::string animation = {};        ///< name or number of it; empty: the one that was baked, else the first
  std::vector<NodeMove> moves = {};  ///< applied in this order after the animation
};

/// The request of a picture: what it shows, and how it is drawn.
struct DrawRequest {
  std::optional<Shading> shading = {};   ///< none: the best for which the bake holds data
  ShadingOptions options = {};           ///< of the shadings that OpenGL draws
  Lobe lobe = Lobe::Ggx;                 ///< glossy, and lights in phong
  std::vector<GroupFactor> groups = {};  ///< lights; groups that are not named shine as in the file
  FullOptions full = {};                 ///< of full shading
  InstantOptions instant = {};           ///< of instant shading
  std::optional<int> width = {};  ///< pixels, up to maxSize; none: from the height and the camera's aspect
  int height = 720;               ///< pixels, 1 to maxSize
  int samplesPerAxis = 2;         ///< of shadings that OpenGL draws: this squared per pixel, 1 to 8
  std::optional<Camera> camera = {};  ///< none: `cameraIndex`
  std::optional<int> cameraIndex =
      {};  ///< into Scene::cameras; none: the first, or one that frames the scene
  std::optional<std::vector<Light>> lights = {};  ///< in world space; none: the scene's
  std::shared_ptr<const Environment> sky = {};    ///< nullptr: `skyName`
  /// File or built-in name of a sky ("studio", "neutral", "preetham:3:35"); empty: the sky that was baked
  /// under, else that of the scene's file, else, where nothing else gives light, the studio.
  std::string skyName = {};
  double skyRotation = 0.0;          ///< radians, counter-clockwise seen from above
  std::string encoding = {};         ///< lightmap, radiosity: encoding of light to draw; empty: irradiance
  std::uint64_t causticPhotons = 0;  ///< adds caustics of this many photons to what OpenGL draws; 0: none
  ObjectOptions objects = {};
  Pose pose = {};
  bool denoise = false;  ///< full: by Open Image Denoise, which must be installed (docs/denoising.md)
  bool layers = false;   ///< also returns the parts that sum up to the picture
  /// How data are baked that the shading needs and the bake does not hold: its effort, seed and limits, and
  /// parts of the techniques that it needs. Its seed is also that of photons and paths.
  BakeRequest bake = {};

  static constexpr int maxSize = 16384;
};

/// Options of draw() besides the scene and the request.
struct DrawOptions {
  const Bake* bake = nullptr;      ///< of the scene; nullptr: the one that its file carries, if any
  const Device* device = nullptr;  ///< nullptr: the default device, opened when it is needed
  Progress* progress = nullptr;    ///< nullptr: no progress reports, no interruption
};

/// A picture that was drawn.
struct Drawing {
  Picture picture;
  /// The parts that the picture is the sum of ("direct.R"), and the openness of surfaces ("ao.Y") if the
  /// shading knows it. Empty unless asked for. writePicture() stores them in an .exr.
  std::vector<PictureChannel> layers;
  Shading shading = Shading::Phong;  ///< the shading that was drawn
  std::vector<PlannedPass> passes;   ///< what was drawn or traced beside surfaces, or left out, and why
  bool studio = false;               ///< the built-in studio lights it: meteredExposure() suits its .png
  /// The bake that it was drawn from, with what was baked for it: it spares the next call that work. Of full
  /// and instant shading, and of scenes that are posed or hold further objects: nullptr.
  std::shared_ptr<const Bake> bake;
  std::vector<std::string> notes;           ///< what was chosen without being asked for
  std::vector<std::string> approximations;  ///< what the shading cannot show as it is
  Warnings warnings;                        ///< likely mistakes
};

/// Draws a picture of linear radiance, W/(m2 sr), as `prelight render` does, and bakes what its shading needs
/// and the bake lacks. Equal arguments give equal pixels on the same device. Throws
///   UsageError   for options out of range, or that exclude one another
///   InputError   for a scene or bake without what the request needs, and for files that cannot be read
///   Error        where OpenGL, the device or the denoiser fails
///   Interrupted  if `progress` asks to stop
Drawing draw(const LoadedScene& scene, const DrawRequest& request = {}, const DrawOptions& options = {});

/// Returns the name of a shading in files and on the command line, such as "sh".
std::string_view nameOf(Shading shading);

/// Returns the shading of a name. Throws UsageError that lists the known names.
Shading shadingNamed(std::string_view name);

/// A shading and what it is in a few words.
struct ShadingSummary {
  Shading shading = Shading::Phong;
  std::string_view name;
  std::string_view summary;
};

/// Returns all shadings, in the order of the enumeration.
std::vector<ShadingSummary> shadings();

}  // namespace prelight
