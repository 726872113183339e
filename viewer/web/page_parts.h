#pragma once

#include <set>
#include <string>

#include "viewer/lights/view_lights.h"
#include "viewer/web/web_page.h"

/// The parts that a page's scene is made of.
namespace prelight::viewer {

/// Vertices and triangles.
void addGeometry(const RenderInputs& inputs, PageScene& page);

/// Surfaces with their textures, and the triangles of each.
void addSurfaces(const PageContents& contents, PageScene& page);

/// Cameras, lights and skies.
void addCameras(const RenderInputs& inputs, PageScene& page);
void addLights(const RenderInputs& inputs, PageScene& page);
void addSkies(const PageContents& contents, PageScene& page);

/// Motion of an animation, and SH transfer at its keys. Called after addCameras().
void addMotion(const RenderInputs& inputs, PageScene& page);

/// Baked data, and rules of drawing for each shading.
void addTechniques(const RenderInputs& inputs, PageScene& page);

/// Each adds the numbers that a bake has for a shading, and returns their description.
nlohmann::ordered_json pageSh(const RenderInputs& inputs, PageData& data);
nlohmann::ordered_json pageCh(const RenderInputs& inputs, PageData& data);
nlohmann::ordered_json pageGlossy(const RenderInputs& inputs, PageData& data);
nlohmann::ordered_json pageHaar(const RenderInputs& inputs, PageData& data);
nlohmann::ordered_json pageLightGroups(const RenderInputs& inputs, PageData& data);
nlohmann::ordered_json pageLightMap(const RenderInputs& inputs, PageData& data);
nlohmann::ordered_json pageRadiosity(const RenderInputs& inputs, PageData& data);
nlohmann::ordered_json pageOccluders(const RenderInputs& inputs, PageData& data);
nlohmann::ordered_json pageCones(const RenderInputs& inputs, PageData& data);
nlohmann::ordered_json pageAo(const RenderInputs& inputs, PageData& data);

/// {name: text} of the shaders that pages are drawn with, but for those of prelight.js.
nlohmann::ordered_json pageShaders(const std::set<std::string>& ambients);

/// Numbers of a vector or matrix, in their order in memory.
template <typename T>
nlohmann::ordered_json numbersOf(const T& value) {
  nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < sizeof(T) / sizeof(typename T::value_type); ++i)
    numbers.push_back(reinterpret_cast<const typename T::value_type*>(&value)[i]);
  return numbers;
}

}  // namespace prelight::viewer
