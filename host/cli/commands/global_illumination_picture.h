#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cli/commands/picture_options.h"
#include "cli/commands/picture_sequence.h"
#include "integrators/global_illumination_renderer.h"

namespace prelight::cli {

/// Adds the options of light in pictures of global illumination.
void addGlobalIlluminationOptions(CLI::App& app, GlobalIlluminationPictureRequest& request);

/// Computes a picture with all light and writes it, as `render --shading full` does.
void renderGlobalIlluminationPicture(Session& session, const PictureOptions& options,
                                     const std::filesystem::path& output);

/// Tells what that picture would take, and writes nothing.
void planGlobalIlluminationPicture(Session& session, const PictureOptions& options,
                                   const std::filesystem::path& output);

/// Computes and writes one picture for each moment of an animation, with all light computed anew. A scene
/// without cameras is framed once, the sky is chosen once, and every .png has the exposure of the first
/// picture.
void renderGlobalIlluminationSequence(Session& session, const PictureOptions& options, double framesASecond,
                                      const std::filesystem::path& output);

}  // namespace prelight::cli
