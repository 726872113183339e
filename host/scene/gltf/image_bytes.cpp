#include "scene/gltf/image_bytes.h"

#include "scene/gltf/gltf_validate.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

std::span<const std::uint8_t> imageBytes(const GltfDocument& document, std::size_t index) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  const JsonCursor reference = root.at("images").at(index).at("bufferView");
  const JsonCursor view =
      root.at("bufferViews").at(reference.asIndex(root.countOf("bufferViews"), "buffer view"));
  validateBufferView(root, view);
  return std::span(document.bin)
      .subspan(view.unsignedOr("byteOffset", 0), view.at("byteLength").asUnsigned());
}

}  // namespace prelight
