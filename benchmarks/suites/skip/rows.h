#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "integrators/reference.h"
#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "prelight/scene.h"
#include "prelight/techniques.h"

/// Cases of `skip`: a scene and a request, with a feature absent, present but not needed, and needed; and
/// changes of built-in scenes that add or remove a feature.
namespace prelight::benchmarks::skip {

/// A way to make a picture.
enum class PictureMethod : std::uint8_t { PathTracing, GlobalIllumination };

struct PictureWork {
  PictureMethod method = PictureMethod::PathTracing;
  int side = 0;  ///< pixels
  std::uint32_t samples = 0;
};

/// A scene with a bake or a picture to make of it.
struct Setting {
  Scene scene;
  BakeRequest bake = {};
  std::optional<PictureWork> picture = {};
  std::shared_ptr<const Environment> sky = nullptr;  ///< sky of a picture
};

/// Effort of the measurements.
struct Effort {
  std::uint64_t rays = 256;  ///< per vertex, texel or element
  std::uint64_t photons = 100000;
  double texelSize = 0.06;     ///< size of a light map's texels, m
  double patchSize = 0.0;      ///< size of radiosity patches, m; 0: chosen by the program
  int side = 192;              ///< pixels of pictures
  std::uint32_t samples = 16;  ///< per pixel
};

enum class Presence : std::uint8_t { Absent, Unneeded, Needed };

/// A feature that can be left out, and settings that show it.
struct Row {
  std::string name;      ///< "bounces"
  std::string unneeded;  ///< how the feature is present but not needed: "every surface is black"
  std::string needed;    ///< how it is needed
  Setting (*make)(Presence presence, const Effort& effort);
};

/// Returns rows of features that bakes of visibility and transfer can leave out.
std::vector<Row> transferRows();

/// Returns rows of features that light maps and radiosity can leave out.
std::vector<Row> staticLightRows();

/// Returns rows of features that pictures, path-traced or with photons, can leave out.
std::vector<Row> pictureRows();

/// Returns all rows.
std::vector<Row> rows();

/// Returns a built-in scene as loaded from its file.
Scene builtin(const std::string& name);

/// Returns a bake of AO and SH of order 3 of a built-in scene.
Setting transferOf(const std::string& scene, const Effort& effort);

/// Returns a bake of a light map of a built-in scene.
Setting lightMapOf(const std::string& scene, const Effort& effort);

/// Returns a bake of radiosity of a built-in scene.
Setting radiosityOf(const std::string& scene, const Effort& effort);

/// Returns a picture of a built-in scene.
Setting pictureOf(const std::string& scene, PictureMethod method, const Effort& effort);

/// A change of a material.
using MaterialEdit = void (*)(Material&);

/// If needed, changes the materials of all triangles but lights. If not needed, adds such a material that no
/// triangle has.
void editMaterials(Scene& scene, Presence presence, MaterialEdit edit);

/// A row's text for a feature that editMaterials() adds without need.
inline constexpr const char* ofNoTriangle = "of a material that no triangle has";

/// Functions for editMaterials().
void mirror(Material& material);
void glass(Material& material);
void translucent(Material& material);

/// Adds an opaque texture of a few colours, or of one colour if `flat`, and missing texture coordinates.
/// Returns its index.
int addTexture(Scene& scene, bool flat);

/// Gives a texture (see addTexture()) to every material, or, if not needed, to a new material that no
/// triangle has.
void giveTexture(Scene& scene, Presence presence, TextureRef Material::*texture, bool flat);

/// Adds a point light below the ceiling of `cornell` and scenes in the same room; it is black if not needed.
void addLight(Scene& scene, Presence presence);

void takeLightsAway(Scene& scene);
void blacken(Scene& scene);  ///< makes every material black, so that nothing is reflected

/// Returns a white sky, a black one if not needed, or nullptr if absent.
std::shared_ptr<const Environment> skyOf(Presence presence);

}  // namespace prelight::benchmarks::skip
