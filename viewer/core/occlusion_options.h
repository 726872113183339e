#pragma once

#include <algorithm>

#include "prelight/shading.h"

namespace prelight::viewer {

using prelight::OcclusionMethod;
using prelight::ScreenOcclusionOptions;

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
