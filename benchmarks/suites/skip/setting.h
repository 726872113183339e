#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "integrators/reference.h"
#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "prelight/request.h"
#include "prelight/scene.h"

/// Cases of `skip`: a scene and a request, with a feature absent, present but not needed, and
/// needed.
namespace prelight::benchmarks::skip {

/// How a picture is made.
enum class PictureMethod : std::uint8_t { PathTracing, GlobalIllumination };

struct PictureWork {
  PictureMethod method = PictureMethod::PathTracing;
  int side = 0;  ///< pixels
  std::uint32_t samples = 0;
};

/// A bake where there is no picture.
struct Setting {
  Scene scene;
  BakeRequest bake = {};
  std::optional<PictureWork> picture = {};
  std::shared_ptr<const Environment> sky = nullptr;  ///< sky of a picture
};

/// How much is measured.
struct Effort {
  std::uint64_t rays = 256;  ///< a vertex, texel or element
  std::uint64_t photons = 100000;
  double texelSize = 0.06;     ///< m, of light maps
  double patchSize = 0.0;      ///< m, of radiosity; 0: chosen
  int side = 192;              ///< pixels of pictures
  std::uint32_t samples = 16;  ///< a pixel
};

enum class Presence : std::uint8_t { Absent, Unneeded, Needed };

/// A rule that leaves something out.
struct Row {
  std::string name;      ///< "bounces"
  std::string unneeded;  ///< how the feature is present and yet not needed: "every surface is black"
  std::string needed;    ///< how it is needed
  Setting (*make)(Presence presence, const Effort& effort);
};

}  // namespace prelight::benchmarks::skip
