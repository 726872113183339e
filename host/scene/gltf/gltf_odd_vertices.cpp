#include <cmath>
#include <vector>

#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_oddities.h"
#include "scene/gltf/json_parts.h"
#include "scene/gltf/missing_data.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

/// Squared lengths of unit vectors quantised to 8 bits or fewer lie within this distance of 1.
constexpr float unitTolerance = 0.03f;

bool areUnit(const std::vector<float>& values, std::size_t components) {
  for (std::size_t i = 0; i + components <= values.size(); i += components) {
    const float square =
        values[i] * values[i] + values[i + 1] * values[i + 1] + values[i + 2] * values[i + 2];
    if (!(std::abs(square - 1.0f) <= unitTolerance)) return false;
  }
  return true;
}

void findOddVectors(const AccessorReader& reader, const std::string& name, const std::string& place,
                    Oddities& odd) {
  const std::size_t components = reader.components();
  if (name.starts_with("COLOR_")) {
    for (const float value : reader.floats())
      if (!(value >= 0.0f && value <= 1.0f)) return odd.add("colours outside of 0..1", place);
  } else if ((name == "NORMAL" && components == 3) || (name == "TANGENT" && components == 4)) {
    const std::vector<float> values = reader.floats();
    if (!areUnit(values, components))
      odd.add("vectors that are not of length 1; they are taken as if", place);
    for (std::size_t i = 3; components == 4 && i < values.size(); i += 4)
      if (std::abs(values[i]) != 1.0f) return odd.add("tangents whose w is neither 1 nor -1", place);
  }
}

void findRestarts(const AccessorReader& reader, const Json& accessor, const std::string& place,
                  Oddities& odd) {
  constexpr double uint8 = 5121.0, uint16 = 5123.0;
  const double type = numberOf(part(accessor, "componentType"), 0.0);
  const std::uint32_t restart = type == uint8 ? 0xFFu : type == uint16 ? 0xFFFFu : 0xFFFFFFFFu;
  for (const std::uint32_t index : reader.unsignedIntegers())
    if (index == restart)
      return odd.add("an index that would restart a strip, which glTF has none of", place);
}

}  // namespace

void findOddVertices(const GltfDocument& document, std::uint64_t& left, Oddities& odd) {
  const Json& root = document.json;
  forEachPart(root, "meshes", [&](const Json& mesh, const std::string& meshPlace) {
    const Json& primitives = part(mesh, "primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const std::string place = fmt::format("{}/primitives/{}", meshPlace, p);
      const Json& attributes = part(primitives[p], "attributes");
      for (const auto& attribute : attributes.items()) {
        const auto index = unsignedValue(attribute.value());
        if (!index) continue;
        forReadable(document, *index, left, [&](const AccessorReader& reader) {
          findOddVectors(reader, attribute.key(), place + "/attributes/" + attribute.key(), odd);
        });
      }
      if (const auto index = unsignedValue(part(primitives[p], "indices")))
        forReadable(document, *index, left, [&](const AccessorReader& reader) {
          findRestarts(reader, partAt(part(root, "accessors"), part(primitives[p], "indices")),
                       place + "/indices", odd);
        });
    }
  });
}

}  // namespace prelight
