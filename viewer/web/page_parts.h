#pragma once

#include "viewer/view_lights.h"
#include "viewer/web/web_page.h"

/// The parts that a page's scene is made of.
namespace prelight::viewer {

/// Vertices and triangles.
void addGeometry(const RenderInputs& inputs, PageScene& page);

/// What surfaces look like, with their textures, and which triangles are whose.
void addSurfaces(const PageContents& contents, PageScene& page);

/// Cameras, lights and skies.
void addCameras(const RenderInputs& inputs, PageScene& page);
void addLights(const RenderInputs& inputs, PageScene& page);
void addSkies(const PageContents& contents, PageScene& page);

/// What an animation moves, and SH transfer at its keys. After the cameras.
void addMotion(const RenderInputs& inputs, PageScene& page);

/// What was baked, and how shadings are drawn.
void addTechniques(const RenderInputs& inputs, PageScene& page);

/// {name: text} of all shaders that pages are drawn with.
nlohmann::ordered_json pageShaders();

/// Numbers of a vector or matrix, in their order in memory.
template <typename T>
nlohmann::ordered_json numbersOf(const T& value) {
  nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < sizeof(T) / sizeof(typename T::value_type); ++i)
    numbers.push_back(reinterpret_cast<const typename T::value_type*>(&value)[i]);
  return numbers;
}

}  // namespace prelight::viewer
