#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/session.h"
#include "prelight/picture.h"

namespace prelight::cli {

/// How bright a .png or a window shows radiance.
struct ExposureOption {
  std::optional<double> factor;  ///< of radiance; none: metered in a studio, else 1
  bool automatic = false;        ///< metered everywhere
};

/// --env: a file or the name of a built-in sky.
void addSkyOption(CLI::App& app, std::filesystem::path& sky, const char* help);

/// Says which primitives are inside out, of which there is at least one.
std::string insideOutText(const LoadedScene& loaded, const std::vector<std::uint32_t>& primitives);

/// --exposure.
void addExposureOption(CLI::App& app, ExposureOption& option);

/// Whether a name is that of a built-in sky, or of a kind of them.
bool isBuiltinSky(const std::string& name);
constexpr const char* studioName = "studio";

/// A sky of a file, or a built-in one by its name. Throws as readEnvironment().
Environment readNamedSky(const std::filesystem::path& nameOrFile);

/// The sky of a picture.
struct PictureSky {
  std::optional<Environment> map;
  bool studio = false;    ///< it is the built-in studio
  std::string name = {};  ///< where it has one
  double rotation = 0.0;  ///< radians, that it has by itself
};

/// The sky that is asked for, the one that the file's light was baked under, the file's own, the studio where
/// nothing at all gives light (which is said), or none. `lightsAsked`: the options say what lights there are.
/// `lightBaked`: the file carries light as it was when baked. `camera`: the one that is asked for.
PictureSky choosePictureSky(Session& session, const std::filesystem::path& asked, bool lightsAsked,
                            bool lightBaked, const LoadedScene& loaded, std::optional<int> camera);

/// Prepares a scene without cameras for the studio: what is inside out and carries no bake is turned, which
/// is said, and a camera added that shows the scene large in a picture of this size.
void setUpStudio(Session& session, LoadedScene& loaded, std::optional<int> width, int height);

/// A picture and what an .exr holds besides.
struct LayeredPicture {
  Picture picture = {};
  std::vector<PictureChannel> layers = {};  ///< none where it is written as .png
};

/// Whether a picture is written with layers.
bool takesLayers(const std::filesystem::path& output);

/// Writes a picture: .exr as it is with its layers, .png with the exposure that was asked for or that suits
/// it, which is said where it is not 1. Returns the exposure; none for an .exr.
std::optional<double> writeExposed(Session& session, const std::filesystem::path& output,
                                   const LayeredPicture& layered, const ExposureOption& option, bool studio);

/// What .png and windows are to show radiance with; none: what suits the picture.
std::optional<double> exposureAskedFor(const ExposureOption& option, bool studio);

/// Says an exposure that was metered.
void noteExposure(Session& session, double exposure);

/// Adds to a report whether the picture is of the studio, and its exposure.
void addLook(nlohmann::ordered_json& report, bool studio, std::optional<double> exposure);

}  // namespace prelight::cli
