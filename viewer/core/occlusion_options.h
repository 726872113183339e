#pragma once

#include <algorithm>
#include <cstdint>

namespace prelight::viewer {

/// How what occludes a pixel is found: among the surfaces of the picture, or, by Disks and Fields, among all
/// of the scene. Ssdo finds which light arrives.
enum class OcclusionMethod : std::uint8_t { Ssao, Hbao, Gtao, Ssdo, Disks, Fields };

/// Occlusion of what is seen in a picture, found while it is drawn.
struct ScreenOcclusionOptions {
  OcclusionMethod method = OcclusionMethod::Gtao;
  double radius = 0.0;       ///< m, what is farther occludes nothing; 0: a share of the scene's size
  int slices = 4;            ///< of Gtao and Ssdo, and pairs of directions of Hbao
  int steps = 8;             ///< of each side of a slice
  int samples = 32;          ///< of Ssao
  int layers = 2;            ///< of surfaces that Gtao and Ssdo look at: 1 or 2
  double thickness = 0.0;    ///< m, of what has no back in the second layer; of both
  double elementSize = 0.0;  ///< m, of the longest edge of an element of Disks; 0: a share of the radius
  double opening = 0.4;      ///< radius over distance of groups that Disks does not take apart
  int passes = 1;            ///< of Disks: all but the last find how open the backs of elements are
  int bounces = 1;           ///< of Ssdo: light that surfaces in the picture send on, 0 or 1 times
  int stride = 1;            ///< pixels from one that occlusion is looked for at to the next, each way
  int frames = 1;            ///< pictures with turned samples whose mean is shown
  int cells = 1 << 15;       ///< of the field of an object, about; of Fields
  int fieldRays = 128;       ///< of a cell, a power of two, 16 and more; of Fields
  bool filtered = true;      ///< pixels of one surface are averaged

  bool operator==(const ScreenOcclusionOptions&) const = default;
};

/// Layers of surfaces that have to be drawn for it.
constexpr int layersOf(const ScreenOcclusionOptions& options) {
  const bool slices = options.method == OcclusionMethod::Gtao || options.method == OcclusionMethod::Ssdo;
  return slices ? options.layers : 1;
}

/// Light that surfaces of the picture send is gathered.
constexpr bool gathers(const ScreenOcclusionOptions& options) {
  return options.method == OcclusionMethod::Ssdo && options.bounces > 0;
}

/// Whether the method sees only the picture, and so needs a margin around it.
constexpr bool looksAround(const ScreenOcclusionOptions& options) {
  return options.method < OcclusionMethod::Disks;
}

/// Fields are smooth; a filter would only blur what they know of contacts.
constexpr bool isFiltered(const ScreenOcclusionOptions& options) {
  return options.filtered && options.method != OcclusionMethod::Fields;
}

/// Options at about a quarter of the cost, while something moves.
constexpr ScreenOcclusionOptions draftOf(ScreenOcclusionOptions options) {
  options.slices = std::max(options.slices / 2, 1);
  options.steps = std::max(options.steps / 2, 1);
  options.samples = std::max(options.samples / 4, 1);
  options.opening = 2.0 * options.opening;
  return options;
}

/// Default radius as a share of the diagonal of the scene's bounds.
constexpr double occlusionRadiusShare = 0.1;

}  // namespace prelight::viewer
