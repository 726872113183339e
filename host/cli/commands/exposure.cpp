#include "cli/commands/exposure.h"

#include <fmt/format.h>

#include "cli/options/values.h"
#include "images/pixels.h"

namespace prelight::cli {
namespace {

/// Notes that much of a picture is burnt out. Lamps in physical units may be thousands of times too bright
/// for one.
void noteBurntPicture(Session& session, const Picture& picture) {
  constexpr double likely = 0.125;
  const double metered = meteredExposure(picture);
  if (metered > likely) return;
  session.note(fmt::format("the picture is far too bright: --exposure {:g} suits it (or auto)", metered));
}

}  // namespace

void addExposureOption(CLI::App& app, ExposureOption& option) {
  app.add_option_function<std::string>(
         "--exposure",
         [&](const std::string& text) {
           option.automatic = text == "auto";
           if (option.automatic) return;
           option.factor = parseRealNumber("--exposure", text, {leastExposure, mostExposure}, ", or auto");
         },
         "factor for radiance in .png and windows, or auto, metered from the picture (default: auto in the "
         "studio, else 1)")
      ->type_name("N|auto");
}

std::optional<double> exposureAskedFor(const ExposureOption& option, bool studio) {
  if (option.automatic || (studio && !option.factor)) return std::nullopt;
  return option.factor.value_or(1.0);
}

bool takesLayers(const std::filesystem::path& output) { return lowerExtension(output) == ".exr"; }

std::optional<double> writeExposed(Session& session, const std::filesystem::path& output,
                                   const pictures::LayeredPicture& layered, const ExposureOption& option,
                                   bool studio) {
  const Picture& picture = layered.picture;
  std::optional<double> exposure;
  if (!takesLayers(output)) {
    const std::optional<double> asked = exposureAskedFor(option, studio);
    exposure = asked ? *asked : meteredExposure(picture);
  } else if (option.factor || option.automatic) {
    session.warn(
        "--exposure: ignored for .exr, which holds radiance as it is; it applies to .png and windows");
  }
  {
    const StopSignals::SafePoints writing(session.signals());
    session.measure("write", [&] {
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
  session.note(fmt::format("exposure {:g}, metered from the picture (--exposure N sets it)", exposure));
}

void addLook(nlohmann::ordered_json& report, bool studio, std::optional<double> exposure) {
  report["studio"] = studio;
  report["exposure"] = exposure ? nlohmann::ordered_json(*exposure) : nlohmann::ordered_json(nullptr);
}

}  // namespace prelight::cli
