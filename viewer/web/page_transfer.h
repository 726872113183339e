#pragma once

#include "viewer/web/web_page.h"

/// What pages draw each shading from: a function each adds the numbers that a bake has of it, and describes
/// them.
namespace prelight::viewer {

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

}  // namespace prelight::viewer
