#pragma once

#include <functional>
#include <span>
#include <vector>

#include "images/picture_parts.h"
#include "viewer/core/layer_factors.h"
#include "viewer/core/render_inputs.h"
#include "viewer/core/view_state.h"

namespace prelight::viewer {

/// The parts that pictures of a view are sums of, and their accessibility where the shading has one.
std::vector<DrawnLayer> layersOf(const View& view, const RenderInputs& inputs);

/// Layers that a picture is drawn in besides itself. `drawn` is called whenever the target holds one; before,
/// without a layer, when it holds the picture.
struct LayerRequest {
  std::span<const DrawnLayer> layers;
  std::function<void(const DrawnLayer* layer)> drawn;
};

/// Appends a layer's channels: three of a part, one of accessibility.
void addLayer(DrawnLayer layer, std::vector<glm::vec3> pixels, std::vector<PictureChannel>& channels);

}  // namespace prelight::viewer
