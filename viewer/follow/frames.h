#pragma once

#include <functional>
#include <span>

#include "viewer/core/render_options.h"
#include "viewer/follow/posed_scene.h"

namespace prelight::viewer {

/// Is told a picture and its layers, where the options want some, and its place in the sequence.
using FrameSink =
    std::function<void(std::size_t frame, const Picture& picture, const std::vector<PictureChannel>& layers)>;

/// Draws a scene at moments of its animations, one after the other: the pictures that renderPicture makes of
/// it then. A scene without cameras is framed once. Throws as renderPicture; global illumination and caustics
/// are of one moment.
void renderFrames(const RenderInputs& inputs, const RenderOptions& options, const PoseSources& sources,
                  std::span<const SceneMoment> moments, const FrameSink& take, Warnings& notes);

}  // namespace prelight::viewer
