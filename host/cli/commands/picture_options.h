#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/commands/exposure.h"
#include "cli/session.h"
#include "pictures/picture_request.h"
#include "pictures/shaded_scene.h"

namespace prelight::cli {

/// The options of render and view.
struct PictureOptions : pictures::PictureRequest {
  ExposureOption exposure;
};

void addPictureOptions(CLI::App& app, PictureOptions& options);

/// Throws where the picture, the option's value, or the folder of kernels cannot be written.
void checkPictureOutputs(const PictureOptions& options, const char* option,
                         const std::filesystem::path& output);

/// The members that reports of one drawn picture and of several have in common.
nlohmann::ordered_json drawnReport(Session& session, const PictureOptions& options,
                                   const std::filesystem::path& output, const pictures::ShadedScene& shaded,
                                   const Warnings& notes);

}  // namespace prelight::cli
