#include "viewer/frame/picture_layers.h"

#include <array>
#include <utility>

#include "viewer/cubes/object_cubes.h"

namespace prelight::viewer {
namespace {

constexpr const char* accessibilityName = "ao.Y";

/// Light that creases reflect into themselves, or that ssdo finds to be sent on.
bool findsIndirectLight(const View& view) {
  if (infoOf(view.shading).rules.ambient == Ambient::Screen && gathers(view.screenOcclusion)) return true;
  return view.aoCorrection != AoCorrection::None && infoOf(view.shading).traits.creaseCorrection;
}

}  // namespace

std::vector<DrawnLayer> layersOf(const View& view, const RenderInputs& inputs) {
  const bool isFull = showsAllLight(view.shading);
  const bool isBaked =
      rulesOf(view.shading, inputs).through != Through::None || ObjectCubes::areIn(view.shading, inputs);
  std::array<bool, pictureParts> has{};
  const auto add = [&](PicturePart part, bool present) { has[static_cast<std::size_t>(part)] = present; };
  add(PicturePart::Emitted, true);
  add(PicturePart::Direct, true);
  add(PicturePart::Indirect, isFull || findsIndirectLight(view));
  add(PicturePart::Caustic, isFull || inputs.caustics != nullptr);
  add(PicturePart::Reflected, true);
  add(PicturePart::Baked, isBaked);
  std::vector<DrawnLayer> layers;
  for (std::size_t part = 0; part < pictureParts; ++part)
    if (has[part]) layers.push_back(static_cast<DrawnLayer>(part));
  if (infoOf(view.shading).traits.accessibility) layers.push_back(accessibilityLayer);
  return layers;
}

void addLayer(DrawnLayer layer, std::vector<glm::vec3> pixels, std::vector<PictureChannel>& channels) {
  if (layer != accessibilityLayer) {
    const PartPicture part{static_cast<PicturePart>(layer), std::move(pixels)};
    addLayers(std::span(&part, 1), channels);
    return;
  }
  PictureChannel channel{accessibilityName, {}};
  for (const glm::vec3& pixel : pixels) channel.values.push_back(pixel.x);
  channels.push_back(std::move(channel));
}

}  // namespace prelight::viewer
