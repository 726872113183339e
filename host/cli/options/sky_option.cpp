#include "cli/options/sky_option.h"

#include <fmt/format.h>

#include "pictures/named_sky.h"

namespace prelight::cli {

void addSkyOption(CLI::App& app, std::filesystem::path& sky, const char* help) {
  app.add_option(
         "--env", sky,
         fmt::format("{}: equirectangular .hdr or .exr, or the built-in {}, {} (radiance 1) or "
                     "{}TURBIDITY:ELEVATION[:AZIMUTH][{}], a day without clouds",
                     help, pictures::studioName, pictures::neutralName, pictures::dayName, pictures::sunName))
      ->type_name("MAP");
}

}  // namespace prelight::cli
