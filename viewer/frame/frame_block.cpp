#include "viewer/frame/frame_block.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/sh.h"
#include "viewer/core/camera.h"

namespace prelight::viewer {
namespace {

/// Scale (xy) and centre (zw) of a tile in the clip space of its picture.
glm::dvec4 pictureFromTile(const View& view, const Tile& tile) {
  return {static_cast<double>(tile.width) / view.width, static_cast<double>(tile.height) / view.height,
          (2.0 * tile.x + tile.width) / view.width - 1.0, 1.0 - (2.0 * tile.y + tile.height) / view.height};
}

/// Clip space of a tile from that of its picture.
glm::dmat4 cropTo(const View& view, const Tile& tile) {
  const glm::dvec4 place = pictureFromTile(view, tile);
  glm::dmat4 crop(1.0);
  crop[0][0] = 1.0 / place.x;
  crop[1][1] = 1.0 / place.y;
  crop[3][0] = -place.z / place.x;
  crop[3][1] = -place.w / place.y;
  return crop;
}

void setCamera(const View& view, const Tile& tile, const CompiledScene& compiled, FrameBlock& frame) {
  const double aspect = static_cast<double>(view.width) / view.height;
  const CameraMatrices camera = cameraMatrices(view.camera, compiled, aspect);
  frame.clipFromScene = tileFromScene(view, tile, compiled);
  frame.eye = glm::vec4(glm::vec3(camera.position), camera.perspective ? 1.0f : 0.0f);
  frame.forward = glm::vec4(glm::vec3(camera.forward), 0.0f);
  frame.tile = pictureFromTile(view, tile);
  const glm::dmat3 axes(glm::transpose(glm::dmat3(camera.view)));
  const double halfHeight = halfHeightOf(view.camera);
  frame.pixelRight = glm::vec4(glm::vec3(axes[0] * halfHeight * aspect), 0.0f);
  frame.pixelUp = glm::vec4(glm::vec3(axes[1] * halfHeight), 0.0f);
}

void setSky(const View& view, const SeenSky& sky, FrameBlock& frame) {
  frame.skyFromWorld = glm::mat4(glm::dmat4(glm::transpose(skyTurn(view.skyRotation))));
  const auto coefficients = sky.coefficients->turned(view.skyRotation, ambientOrder);
  for (int l = 0; l < ambientOrder; ++l) {
    const double cosine = sh::clampedCosine(l);
    for (int i = l * l; i < (l + 1) * (l + 1); ++i)
      frame.ambient[i] = glm::vec4(cosine * coefficients[i], 0.0);
  }
  frame.ambient[0].w = static_cast<float>(sky.coefficients->smoothing(ambientOrder).lambda);
  const double texel = 2.0 * std::numbers::pi / sky.width;
  const double pixel = view.camera.perspective ? 2.0 * std::tan(0.5 * view.camera.yFov) / view.height : texel;
  frame.skyLevels = glm::vec4(std::log2(texel), std::max(0.0, std::log2(pixel / texel)),
                              sky.lamps.empty() ? 0.0 : 1.0, 0.0);
}

}  // namespace

glm::mat4 tileFromScene(const View& view, const Tile& tile, const CompiledScene& compiled) {
  const double aspect = static_cast<double>(view.width) / view.height;
  const CameraMatrices camera = cameraMatrices(view.camera, compiled, aspect);
  return cropTo(view, tile) * camera.projection * camera.view;
}

FrameBlock frameBlockOf(const View& view, const Tile& tile, const CompiledScene& compiled, const SeenSky& sky,
                        std::span<const ShadedLight> lights, int turns) {
  FrameBlock frame{};
  setCamera(view, tile, compiled, frame);
  setSky(view, sky, frame);
  const auto single = std::count_if(lights.begin(), lights.end(), [](const auto& l) { return !l.isSample; });
  frame.counts = {static_cast<int>(lights.size()), static_cast<int>(single), turns, 0};
  return frame;
}

}  // namespace prelight::viewer
