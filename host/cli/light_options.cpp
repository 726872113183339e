#include "cli/light_options.h"

#include <algorithm>

#include "scene/light_shape.h"
#include "viewer/light_option.h"

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
         "area:polygon:x,y,z:...:r,g,b or none; behind a point light :profile=FILE.ies, behind a spot light "
         ":cookie=PICTURE")
      ->type_name("LIGHT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

bool anyDrawnOnly(const std::optional<std::vector<Light>>& lights) {
  return lights && std::any_of(lights->begin(), lights->end(), [](const Light& light) {
           return light.type == LightType::Area || light.cookie != nullptr;
         });
}

bool makeSurfaces(std::optional<std::vector<Light>>& lights, LoadedScene& loaded) {
  if (!lights) return false;
  if (std::any_of(lights->begin(), lights->end(), [](const Light& l) { return l.cookie != nullptr; }))
    throw UsageError("--light spot", "cookies are drawn, and what traces light knows none",
                     "leave the cookie out, or choose another shading than full");
  if (!makeSurfacesOf(*lights, loaded.scene)) return false;
  Warnings said;  // by the scene without them already
  loaded.compiled = compileScene(loaded.scene, said);
  return true;
}

}  // namespace prelight::cli
