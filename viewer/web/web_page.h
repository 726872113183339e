#pragma once

#include <string>
#include <vector>

#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"
#include "viewer/core/render_inputs.h"
#include "viewer/core/render_options.h"
#include "viewer/web/page_data.h"

namespace prelight::viewer {

/// A sky that a page can be lit by.
struct PageSky {
  std::string name;
  Environment map;
};

/// Inputs of a page.
struct PageContents {
  const RenderInputs& inputs;    ///< with a bake; their environment is not looked at
  const GltfDocument& document;  ///< of the scene: its textures go into the page as they are in the file
  std::string title;             ///< of the page
  std::vector<PageSky> skies;    ///< the first one is there when the page opens; none: it is dark outside
  double exposure = 1.0;         ///< when the page opens
};

constexpr int mostSkyWidth = 512;  ///< texels; wider skies are averaged down to it

/// Contents of a page: its description and its numbers.
struct PageScene {
  nlohmann::ordered_json description;
  PageData data;
};

/// Throws UsageError where the bake holds nothing that a page shows.
PageScene pageScene(const PageContents& contents);

/// The whole page of a scene: a single HTML file that needs neither network nor other files, and a browser
/// with WebGL 2. Its shaders are those of viewer/shaders.
std::string webPage(const PageScene& page);

/// Report on the parts of a bake that a page shows, in its order, and leaves out: {shadings: [{name,
/// bytes}], leftOut:
/// [{what, why}], animation: {name, bytes, notes}}, the last where it plays one.
nlohmann::ordered_json pageReport(const PageScene& page);

}  // namespace prelight::viewer
