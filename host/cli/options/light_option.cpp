#include "cli/options/light_option.h"

#include <string>

#include "viewer/options/light_option.h"

namespace prelight::cli {

void addLightOption(CLI::App& app, std::optional<std::vector<Light>>& lights) {
  app.add_option_function<std::vector<std::string>>(
         "--light",
         [&lights](const std::vector<std::string>& texts) {
           if (!lights) lights.emplace();
           for (const std::string& text : texts)
             if (text != "none") lights->push_back(viewer::parseLight(text));
         },
         "replaces the file's lights, once for each light: point:x,y,z:r,g,b, directional:dx,dy,dz:r,g,b, "
         "spot:x,y,z:dx,dy,dz:inner,outer:r,g,b, area:sphere:x,y,z:radius:r,g,b, "
         "area:disk:x,y,z:dx,dy,dz:radius:r,g,b, area:quad:x,y,z:dx,dy,dz:width,height:r,g,b, "
         "area:polygon:x,y,z:...:r,g,b or none; a point light may end in :profile=FILE.ies, a spot light in "
         ":cookie=PICTURE; points and spots with a size in :radius=M, directional lights in :angle=DEG")
      ->type_name("LIGHT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace prelight::cli
