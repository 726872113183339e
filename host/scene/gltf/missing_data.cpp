#include "scene/gltf/missing_data.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

bool isMissing(const GltfDocument& document, const Json& holder) {
  const auto view = holder.is_object() ? unsignedValue(holder.value("bufferView", Json())) : std::nullopt;
  if (!view || !document.json.contains("bufferViews")) return false;
  const Json& views = document.json.at("bufferViews");
  return *view < views.size() && views[*view].value("buffer", Json()) == missingBuffer;
}

}  // namespace

bool lacksData(const GltfDocument& document, std::size_t accessor) {
  const Json& json = document.json.at("accessors").at(accessor);
  const Json sparse = json.value("sparse", Json::object());
  return isMissing(document, json) || isMissing(document, sparse.value("indices", Json())) ||
         isMissing(document, sparse.value("values", Json()));
}

bool lacksData(const GltfDocument& document, const JsonCursor& primitive) {
  bool lacks = false;
  primitive.at("attributes").forEachMember([&](const JsonCursor& attribute, const std::string&) {
    lacks = lacks || lacksData(document, attribute.asUnsigned());
  });
  const auto indices = primitive.find("indices");
  return lacks || (indices && lacksData(document, indices->asUnsigned()));
}

}  // namespace prelight
