#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cli/session.h"
#include "pictures/drawn_picture.h"
#include "prelight/picture.h"

namespace prelight::cli {

/// The exposure with which radiance is shown in a .png or a window.
struct ExposureOption {
  std::optional<double> factor;  ///< factor for radiance; none: metered from the picture
  bool given = false;            ///< the command line has the option
};

/// Adds --exposure.
void addExposureOption(CLI::App& app, ExposureOption& option);

/// Returns whether a picture is written with layers.
bool takesLayers(const std::filesystem::path& output);

/// Writes a picture: an .exr as it is with its layers, a .png with the exposure that was asked for or that
/// suits it, with a note where it was metered. Returns the exposure, or none for an .exr.
std::optional<double> writeExposed(Session& session, const std::filesystem::path& output,
                                   const pictures::LayeredPicture& layered, const ExposureOption& option);

/// Tells of an exposure that was metered.
void noteExposure(Session& session, double exposure);

/// Adds to a report whether the picture shows the studio, and its exposure.
void addLook(nlohmann::ordered_json& report, bool studio, std::optional<double> exposure);

}  // namespace prelight::cli
