#include "pictures/picture_lights.h"

#include <algorithm>

#include "scene/light_shape.h"

namespace prelight::pictures {

bool anyDrawnOnly(const std::optional<std::vector<Light>>& lights) {
  return lights && std::any_of(lights->begin(), lights->end(), [](const Light& light) {
           return light.type == LightType::Area || light.cookie != nullptr;
         });
}

bool makeSurfaces(std::optional<std::vector<Light>>& lights, LoadedScene& loaded) {
  if (!lights) return false;
  if (std::any_of(lights->begin(), lights->end(), [](const Light& l) { return l.cookie != nullptr; }))
    throw UsageError("DrawRequest::lights spot", "cookies can be drawn, but not traced",
                     "leave the cookie out, or choose another shading than full");
  if (!makeSurfacesOf(*lights, loaded.scene)) return false;
  Warnings said;  // these warnings were given for the scene without the lights
  loaded.compiled = compileScene(loaded.scene, said);
  return true;
}

}  // namespace prelight::pictures
