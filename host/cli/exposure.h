#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cli/session.h"
#include "prelight/picture.h"

namespace prelight::cli {

/// How bright a .png or a window shows radiance.
struct ExposureOption {
  std::optional<double> factor;  ///< of radiance; none: metered in a studio, else 1
  bool automatic = false;        ///< metered everywhere
};

/// Adds --exposure.
void addExposureOption(CLI::App& app, ExposureOption& option);

/// A picture and what an .exr holds besides.
struct LayeredPicture {
  Picture picture = {};
  std::vector<PictureChannel> layers = {};  ///< none where it is written as .png
};

/// Returns whether a picture is written with layers.
bool takesLayers(const std::filesystem::path& output);

/// Writes a picture: .exr as it is with its layers, .png with the exposure that was asked for or that suits
/// it, which is said where it is not 1. Returns the exposure; none for an .exr.
std::optional<double> writeExposed(Session& session, const std::filesystem::path& output,
                                   const LayeredPicture& layered, const ExposureOption& option, bool studio);

/// Returns the factor that .png and windows are to show radiance with; none: the one that suits the picture.
std::optional<double> exposureAskedFor(const ExposureOption& option, bool studio);

/// Tells of an exposure that was metered.
void noteExposure(Session& session, double exposure);

/// Adds to a report whether the picture is of the studio, and its exposure.
void addLook(nlohmann::ordered_json& report, bool studio, std::optional<double> exposure);

}  // namespace prelight::cli
