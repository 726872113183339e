#include "cli/picture_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string_view>
#include <utility>

#include "cli/recorded_sky.h"
#include "cli/values.h"
#include "images/pixels.h"
#include "images/preetham_sky.h"
#include "io/baked_file.h"
#include "scene/faint_glow.h"
#include "scene/framing.h"
#include "scene/inside_out.h"
#include "scene/light_sources.h"
#include "viewer/camera.h"

namespace prelight::cli {
namespace {

constexpr const char* neutralName = "neutral";
constexpr std::string_view dayName = "preetham:", sunName = ":sun";
constexpr double widestAspect = 16.0 / 9.0;

/// Such a camera shows a scene by the light that it has.
bool hasCameraWithin(const LoadedScene& loaded) {
  const glm::dvec3 least(loaded.compiled.boundsMin), most(loaded.compiled.boundsMax);
  return std::any_of(loaded.scene.cameras.begin(), loaded.scene.cameras.end(), [&](const Camera& camera) {
    const glm::dvec3 at(camera.world[3]);
    return glm::all(glm::lessThanEqual(least, at)) && glm::all(glm::lessThanEqual(at, most));
  });
}

/// "preetham:TURBIDITY:ELEVATION[:AZIMUTH][:sun]", angles in degrees.
DaySky parseDaySky(const std::string& name) {
  const bool sun = name.ends_with(sunName);
  std::string fields = name.substr(dayName.size());
  if (sun) fields.resize(fields.size() - std::min(fields.size(), sunName.size()));
  std::replace(fields.begin(), fields.end(), ':', ',');
  const std::optional<std::vector<double>> numbers = numbersIn(fields, 360.0);
  const bool counted = numbers && (numbers->size() == 2 || numbers->size() == 3);
  const auto within = [&](std::size_t i, double least, double most) {
    return (*numbers)[i] >= least && (*numbers)[i] <= most;
  };
  if (!counted || !within(0, 2.0, 10.0) || !within(1, 0.0, 90.0))
    throw UsageError("--env " + name, "not a sky of this kind",
                     "expected preetham:TURBIDITY:ELEVATION[:AZIMUTH][:sun], a turbidity from 2 to 10, the "
                     "sun's elevation "
                     "from 0 to 90 degrees, its azimuth from -Z towards +X and whether its disk is there, as "
                     "preetham:3:35:120");
  constexpr double degree = std::numbers::pi / 180.0;
  DaySky day;
  day.turbidity = (*numbers)[0];
  day.elevation = degree * (*numbers)[1];
  day.azimuth = numbers->size() == 3 ? degree * (*numbers)[2] : 0.0;
  day.sun = sun;
  return day;
}

/// The camera that is asked for, or the one that the studio would have.
Camera eyeOf(const LoadedScene& loaded, std::optional<int> camera) {
  return loaded.scene.cameras.empty() && !camera
             ? frameModel(loaded.compiled, widestAspect)
             : viewer::chooseCamera(loaded.scene, loaded.compiled, camera);
}

/// Lamps in physical units may be thousands of times as bright as what a picture shows.
void noteBurntPicture(Session& session, const Picture& picture) {
  constexpr double likely = 0.125;
  const double metered = meteredExposure(picture);
  if (metered > likely) return;
  session.console().note(
      fmt::format("the picture is far too bright: --exposure {:g} suits it (or auto)", metered));
}

}  // namespace

std::string insideOutText(const LoadedScene& loaded, const std::vector<std::uint32_t>& primitives) {
  const PrimitiveRange& first = loaded.compiled.primitives[primitives.front()];
  const std::string more =
      primitives.size() > 1 ? fmt::format(" and {} more", primitives.size() - 1) : std::string();
  return fmt::format("{}: node {} \"{}\"{}: a closed surface whose faces all look inwards is inside out",
                     loaded.path.string(), first.node, first.name, more);
}

void addSkyOption(CLI::App& app, std::filesystem::path& sky, const char* help) {
  app.add_option("--env", sky,
                 fmt::format("{}: equirectangular .hdr or .exr, or the built-in {}, {} (radiance 1) or "
                             "{}TURBIDITY:ELEVATION[:AZIMUTH][{}], a day without clouds",
                             help, studioName, neutralName, dayName, sunName))
      ->type_name("MAP");
}

void addExposureOption(CLI::App& app, ExposureOption& option) {
  app.add_option_function<std::string>(
         "--exposure",
         [&](const std::string& text) {
           option.automatic = text == "auto";
           if (option.automatic) return;
           option.factor = parseRealNumber("--exposure", text, {leastExposure, mostExposure}, ", or auto");
         },
         "factor of radiance in .png and windows, or auto: metered from the picture (default: auto in the "
         "studio, else 1)")
      ->type_name("N|auto");
}

bool isBuiltinSky(const std::string& name) {
  return name == studioName || name == neutralName || name.starts_with(dayName);
}

Environment readNamedSky(const std::filesystem::path& nameOrFile) {
  if (nameOrFile == studioName) return studioEnvironment();
  if (nameOrFile == neutralName) return constantEnvironment(glm::vec3(1.0f));
  if (nameOrFile.string().starts_with(dayName)) return daySky(parseDaySky(nameOrFile.string()));
  return readEnvironment(nameOrFile);
}

PictureSky choosePictureSky(Session& session, const std::filesystem::path& asked, bool lightsAsked,
                            bool lightBaked, const LoadedScene& loaded, std::optional<int> camera) {
  if (!asked.empty())
    return {session.times().measure("sky", [&] { return readNamedSky(asked); }), asked == studioName,
            asked.stem().string()};
  if (!lightsAsked)
    if (std::optional<PictureSky> baked = bakedSkyOf(session, loaded)) return *std::move(baked);
  if (loaded.sky) return {*loaded.sky, false};
  if (lightsAsked || lightBaked) return {};
  const bool shines = hasLights(loaded.compiled);
  const bool glows = shines && !hasCameraWithin(loaded) && onlyGlows(loaded.compiled, eyeOf(loaded, camera));
  if (shines && !glows) return {};
  session.console().note(
      fmt::format("the scene has no light, {} and no sky: lit by the built-in studio (--env {} or a map is "
                  "another sky, --light none leaves the studio out)",
                  glows ? "only a glow that leaves it dark" : "nothing emissive", neutralName));
  return {session.times().measure("sky", [] { return studioEnvironment(); }), true};
}

void setUpStudio(Session& session, LoadedScene& loaded, std::optional<int> width, int height) {
  if (!loaded.scene.cameras.empty()) return;
  if (!readRecordedChoice(loaded.document).baked) {
    const std::vector<std::uint32_t> turned = insideOutPrimitives(loaded.scene, loaded.compiled);
    if (!turned.empty()) {
      session.warn(fmt::format("{}; turned for this picture", insideOutText(loaded, turned)));
      turnFaces(turned, loaded.scene, loaded.compiled);
    }
  }
  const double aspect = width ? static_cast<double>(*width) / height : widestAspect;
  Camera& camera = loaded.scene.cameras.emplace_back(frameModel(loaded.compiled, aspect));
  camera.sceneNode = loaded.scene.nodes.size();
}

std::optional<double> exposureAskedFor(const ExposureOption& option, bool studio) {
  if (option.automatic || (studio && !option.factor)) return std::nullopt;
  return option.factor.value_or(1.0);
}

bool takesLayers(const std::filesystem::path& output) { return lowerExtension(output) == ".exr"; }

std::optional<double> writeExposed(Session& session, const std::filesystem::path& output,
                                   const LayeredPicture& layered, const ExposureOption& option, bool studio) {
  const Picture& picture = layered.picture;
  std::optional<double> exposure;
  if (!takesLayers(output)) {
    const std::optional<double> asked = exposureAskedFor(option, studio);
    exposure = asked ? *asked : meteredExposure(picture);
  } else if (option.factor || option.automatic) {
    session.warn("--exposure: an .exr holds radiance as it is; only .png and windows are exposed");
  }
  {
    const StopSignals::SafePoints writing(session.signals());
    session.times().measure("write", [&] {
      if (exposure)
        writePicture(output, exposed(picture, *exposure));
      else
        writePicture(output, picture, layered.layers);
    });
  }
  if (exposure && !exposureAskedFor(option, studio)) noteExposure(session, *exposure);
  if (exposure && !option.factor && !option.automatic && !studio) noteBurntPicture(session, picture);
  return exposure;
}

void noteExposure(Session& session, double exposure) {
  session.console().note(
      fmt::format("exposure {:g}, metered from the picture (--exposure N sets it)", exposure));
}

void addLook(nlohmann::ordered_json& report, bool studio, std::optional<double> exposure) {
  report["studio"] = studio;
  report["exposure"] = exposure ? nlohmann::ordered_json(*exposure) : nlohmann::ordered_json(nullptr);
}

}  // namespace prelight::cli
