#include "support/bent_bar.h"

#include <cmath>
#include <cstddef>
#include <span>

#include "support/gltf_files.h"

namespace prelight::test {

std::vector<glm::vec3> barPositions() {
  std::vector<glm::vec3> positions;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 2; ++column)
      positions.emplace_back(static_cast<float>(column) - 0.5f, static_cast<float>(row), 0.0f);
  return positions;
}

GltfDocument bentBar() {
  using Json = nlohmann::ordered_json;
  GltfDocument document;
  document.path = "bar.glb";
  document.json = Json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 2]}],
    "nodes": [{"name": "lower", "children": [1]}, {"name": "upper", "translation": [0, 1, 0]},
              {"name": "bar", "mesh": 0, "skin": 0}],
    "materials": [{}]})");
  std::vector<float> positions, normals, weights;
  std::vector<std::uint8_t> joints;
  for (const glm::vec3& p : barPositions()) {
    positions.insert(positions.end(), {p.x, p.y, p.z});
    normals.insert(normals.end(), {1, 0, 0});
    weights.insert(weights.end(), {1.0f - p.y / 2.0f, p.y / 2.0f, 0, 0});
    joints.insert(joints.end(), {0, 1, 0, 0});
  }
  Json primitive = {{"material", 0}};
  primitive["attributes"]["POSITION"] = appendFloats(document, positions, "VEC3");
  primitive["attributes"]["NORMAL"] = appendFloats(document, normals, "VEC3");
  primitive["attributes"]["WEIGHTS_0"] = appendFloats(document, weights, "VEC4");
  primitive["attributes"]["JOINTS_0"] = appendBytes(document, joints, "VEC4", barPositions().size(), 5121);
  primitive["indices"] = appendBytes(document, {0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4}, "SCALAR", 12, 5121);
  document.json["meshes"] = Json::array({{{"name", "bar"}, {"primitives", Json::array({primitive})}}});
  std::vector<float> matrices;
  for (const float up : {0.0f, 1.0f})
    matrices.insert(matrices.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -up, 0, 1});
  const int bind = appendAccessor(document, std::as_bytes(std::span(matrices)), "MAT4", 5126, 2);
  document.json["skins"] =
      Json::array({{{"name", "skin"}, {"joints", {0, 1}}, {"inverseBindMatrices", bind}}});
  const float half = std::sqrt(0.5f);
  const int times = appendFloats(document, {0, 1}, "SCALAR");
  const int turns = appendFloats(document, {0, 0, 0, 1, 0, 0, half, half}, "VEC4");
  document.json["animations"] =
      Json::array({{{"name", "bend"},
                    {"samplers", {{{"input", times}, {"output", turns}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}}}}}});
  return document;
}

}  // namespace prelight::test
