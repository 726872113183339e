#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "prelight/error.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/load_parts.h"
#include "scene/gltf/missing_data.h"

namespace prelight {

namespace {

/// Returns the differences of an attribute, [vertex][component], with 0 for values that are not finite; empty
/// where the target has none.
std::vector<float> readDeltas(const LoadContext& context, const JsonCursor& target, const char* name,
                              std::size_t numbers) {
  const auto attribute = target.find(name);
  if (!attribute) return {};
  if (lacksData(context.document, attribute->asUnsigned())) {
    context.warnings.push_back(attribute->where() + ": its data lie in a buffer that the file leaves out");
    return {};
  }
  const AccessorReader reader(context.document, attribute->asUnsigned());
  if (!reader.hasData()) return {};
  const std::string_view attributeName(name);
  constexpr int float32 = 5126;
  const bool share = attributeName.starts_with("COLOR_") && reader.componentType() != float32;
  std::vector<float> deltas = reader.floats(share);
  std::size_t odd = 0;
  for (float& delta : deltas) {
    if (std::isfinite(delta)) continue;
    delta = 0.0f;
    ++odd;
  }
  if (deltas.size() != numbers)
    attribute->fail(fmt::format("{} numbers, expected {}", deltas.size(), numbers));
  if (odd > 0)
    context.warnings.push_back(
        fmt::format("{}: {} numbers are not finite; they are taken as 0", attribute->where(), odd));
  return deltas;
}

template <class Vector>
std::vector<Vector> asVectors(const std::vector<float>& numbers) {
  constexpr auto width = static_cast<std::size_t>(Vector::length());
  std::vector<Vector> vectors(numbers.size() / width);
  for (std::size_t i = 0; i < vectors.size() * width; ++i)
    vectors[i / width][static_cast<int>(i % width)] = numbers[i];
  return vectors;
}

/// Returns differences of colours. Colours of three numbers leave alpha unchanged.
std::vector<glm::vec4> colorDeltas(const LoadContext& context, const JsonCursor& target,
                                   std::size_t vertices) {
  const auto attribute = target.find("COLOR_0");
  if (!attribute || vertices == 0) return {};
  const std::size_t width =
      componentCount(context.root.at("accessors").at(attribute->asUnsigned()).at("type").asString());
  const std::vector<float> numbers = readDeltas(context, target, "COLOR_0", width * vertices);
  if (width == 4) return asVectors<glm::vec4>(numbers);
  std::vector<glm::vec4> colors;
  for (const glm::vec3& color : asVectors<glm::vec3>(numbers)) colors.emplace_back(color, 0.0f);
  return colors;
}

MorphTarget loadTarget(const LoadContext& context, const JsonCursor& json, const Primitive& primitive) {
  const auto vectors = [&]<class Vector>(const char* name, std::size_t vertices, Vector) {
    constexpr auto width = static_cast<std::size_t>(Vector::length());
    // Attributes that the primitive lacks, such as tangents without normals, cannot change.
    return vertices == 0 ? std::vector<Vector>()
                         : asVectors<Vector>(readDeltas(context, json, name, width * vertices));
  };
  MorphTarget target;
  target.positions = vectors("POSITION", primitive.positions.size(), glm::vec3());
  target.normals = vectors("NORMAL", primitive.normals.size(), glm::vec3());
  target.tangents = vectors("TANGENT", primitive.tangents.size(), glm::vec3());
  target.texCoords0 = vectors("TEXCOORD_0", primitive.texCoords0.size(), glm::vec2());
  target.texCoords1 = vectors("TEXCOORD_1", primitive.texCoords1.size(), glm::vec2());
  target.colors = colorDeltas(context, json, primitive.colors.size());
  return target;
}

}  // namespace

void loadMorphTargets(const LoadContext& context, const JsonCursor& json, Primitive& primitive) {
  json.forEachObject("targets", [&](const JsonCursor& target, std::size_t) {
    primitive.targets.push_back(loadTarget(context, target, primitive));
  });
}

std::size_t countTargets(const Mesh& mesh) {
  std::size_t most = 0;
  for (const Primitive& primitive : mesh.primitives) most = std::max(most, primitive.targets.size());
  return most;
}

std::vector<float> loadWeights(const JsonCursor& holder, const Mesh& mesh) {
  const std::size_t targets = countTargets(mesh);
  const auto json = holder.find("weights");
  if (!json) return mesh.weights;
  std::vector<float> weights(targets, 0.0f);
  for (std::size_t i = 0; i < std::min(json->arraySize(), targets); ++i)
    weights[i] = finiteFloat(json->at(i));
  return weights;
}

}  // namespace prelight
