#include <cmath>
#include <vector>

#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_oddities.h"
#include "scene/gltf/json_parts.h"
#include "scene/gltf/missing_data.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

/// Returns the parent of each node; the node itself for roots and where the hierarchy is cyclic.
std::vector<std::size_t> parentsOf(const Json& root) {
  const Json& nodes = part(root, "nodes");
  std::vector<std::size_t> parents(nodes.size());
  for (std::size_t i = 0; i < parents.size(); ++i) parents[i] = i;
  for (std::size_t i = 0; i < parents.size(); ++i)
    for (const Json& child : part(nodes[i], "children"))
      if (const auto index = unsignedValue(child); index && *index < parents.size()) parents[*index] = i;
  return parents;
}

bool liesBelow(const std::vector<std::size_t>& parents, std::size_t node, std::size_t above) {
  for (std::size_t step = 0; step <= parents.size() && node < parents.size(); ++step) {
    if (node == above) return true;
    if (parents[node] == node) return false;
    node = parents[node];
  }
  return false;
}

}  // namespace

void findOddSkins(const Json& root, Oddities& odd) {
  if (part(root, "skins").empty()) return;
  const std::vector<std::size_t> parents = parentsOf(root);
  constexpr std::size_t mostSteps = std::size_t{1} << 24;  // over all joints up to the root
  std::size_t steps = 0;
  forEachPart(root, "skins", [&](const Json& skin, const std::string& place) {
    const Json& matrices = partAt(part(root, "accessors"), part(skin, "inverseBindMatrices"));
    if (!part(partAt(part(root, "bufferViews"), part(matrices, "bufferView")), "byteStride").is_null())
      odd.add("matrices in a buffer view with a byteStride", place + "/inverseBindMatrices");
    const auto skeleton = unsignedValue(part(skin, "skeleton"));
    if (!skeleton) return;
    for (const Json& joint : part(skin, "joints")) {
      const auto node = unsignedValue(joint);
      if (!node || (steps += parents.size()) > mostSteps) return;
      if (liesBelow(parents, static_cast<std::size_t>(*node), static_cast<std::size_t>(*skeleton))) continue;
      return odd.add("a skeleton that is not above all joints; it is not used", place + "/skeleton");
    }
  });
}

void findOddMatrices(const GltfDocument& document, std::uint64_t& left, Oddities& odd) {
  forEachPart(document.json, "skins", [&](const Json& skin, const std::string& place) {
    const auto index = unsignedValue(part(skin, "inverseBindMatrices"));
    if (!index) return;
    forReadable(document, *index, left, [&](const AccessorReader& reader) {
      constexpr std::size_t entries = 16;
      if (reader.components() != entries) return;
      const std::vector<float> values = reader.floats();
      for (std::size_t i = 0; i + entries <= values.size(); i += entries)
        if (values[i + 3] != 0.0f || values[i + 7] != 0.0f || values[i + 11] != 0.0f ||
            values[i + 15] != 1.0f)
          return odd.add("a matrix whose last row is not 0 0 0 1; that row is not used",
                         place + "/inverseBindMatrices");
    });
  });
}

}  // namespace prelight
