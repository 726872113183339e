#pragma once

#include <cstdint>

namespace prelight::viewer {

/// How the surfaces of a picture are searched for what occludes a pixel.
enum class OcclusionMethod : std::uint8_t { Ssao, Hbao, Gtao };

/// Occlusion in the space of the picture.
struct ScreenOcclusionOptions {
  OcclusionMethod method = OcclusionMethod::Gtao;
  double radius = 0.0;     ///< m, what is farther occludes nothing; 0: a share of the scene's size
  int slices = 4;          ///< of Gtao, and pairs of directions of Hbao
  int steps = 8;           ///< of each side of a slice
  int samples = 32;        ///< of Ssao
  int layers = 2;          ///< of surfaces that Gtao looks at: 1 or 2
  double thickness = 0.0;  ///< m, of what has no back in the second layer; of Gtao
  bool filtered = true;    ///< pixels of one surface are averaged

  bool operator==(const ScreenOcclusionOptions&) const = default;
};

/// Layers of surfaces that have to be drawn for it.
constexpr int layersOf(const ScreenOcclusionOptions& options) {
  return options.method == OcclusionMethod::Gtao ? options.layers : 1;
}

/// The same at about a quarter of the cost, while something moves.
ScreenOcclusionOptions draftOf(ScreenOcclusionOptions options);

/// Of a radius that is not given, a share of the diagonal of the scene's bounds.
constexpr double occlusionRadiusShare = 0.1;

}  // namespace prelight::viewer
