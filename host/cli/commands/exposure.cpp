#include "cli/commands/exposure.h"

#include <fmt/format.h>

#include "cli/options/values.h"
#include "images/pixels.h"

namespace prelight::cli {

void addExposureOption(CLI::App& app, ExposureOption& option) {
  app.add_option_function<std::string>(
         "--exposure",
         [&](const std::string& text) {
           option.given = true;
           option.factor.reset();
           if (text != "auto")
             option.factor = parseRealNumber("--exposure", text, {leastExposure, mostExposure}, ", or auto");
         },
         "factor for radiance in .png and windows, or auto, metered from the picture (default: auto)")
      ->type_name("N|auto");
}

bool takesLayers(const std::filesystem::path& output) { return lowerExtension(output) == ".exr"; }

std::optional<double> writeExposed(Session& session, const std::filesystem::path& output,
                                   const pictures::LayeredPicture& layered, const ExposureOption& option) {
  const Picture& picture = layered.picture;
  std::optional<double> exposure;
  if (!takesLayers(output)) {
    exposure = option.factor ? *option.factor : meteredExposure(picture);
  } else if (option.given) {
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
  if (exposure && !option.factor) noteExposure(session, *exposure);
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
