#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "prelight/error.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/load/load_parts.h"

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

namespace {

constexpr int skinFloat32 = 5126;

/// A sum of weights this near to 1 is rounding: byte-sized integers are off by 1/510 each.
constexpr double weightTolerance = 1e-2;

/// Numbers of vertices with odd weights, by kind.
struct OddWeights {
  std::size_t sums = 0;
  std::size_t signs = 0;
  std::size_t none = 0;
};

/// Reads the sets JOINTS_n and WEIGHTS_n as [vertex][influence].
void readInfluences(const LoadContext& context, const JsonCursor& attributes, Primitive& primitive) {
  if (!attributes.find("JOINTS_0")) return;
  std::map<std::string, std::size_t> accessors;
  attributes.forEachMember([&](const JsonCursor& attribute, const std::string& name) {
    if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) accessors[name] = attribute.asUnsigned();
  });
  std::size_t sets = 0;
  while (accessors.contains(fmt::format("JOINTS_{}", sets)) &&
         accessors.contains(fmt::format("WEIGHTS_{}", sets)))
    ++sets;
  const std::size_t vertices = primitive.positions.size();
  primitive.influences = 4 * sets;
  primitive.joints.assign(vertices * primitive.influences, 0);
  primitive.jointWeights.assign(vertices * primitive.influences, 0.0f);
  for (std::size_t set = 0; set < sets; ++set) {
    const auto read = [&](const char* name) {
      return AccessorReader(context.document, accessors.at(fmt::format("{}_{}", name, set)));
    };
    const AccessorReader weights = read("WEIGHTS");
    const std::vector<std::uint32_t> joints = read("JOINTS").unsignedIntegers();
    const std::vector<float> shares = weights.floats(weights.componentType() != skinFloat32);
    for (std::size_t i = 0; i < std::min({4 * vertices, joints.size(), shares.size()}); ++i) {
      const std::size_t place = i / 4 * primitive.influences + 4 * set + i % 4;
      primitive.joints[place] = joints[i];
      primitive.jointWeights[place] = shares[i];
    }
  }
}

/// Normalises the weights of a vertex to a sum of 1. A vertex without weights follows its first joint.
void normaliseWeights(std::span<float> weights, OddWeights& odd) {
  double sum = 0.0;
  bool negative = false;
  for (float& weight : weights) {
    if (!(weight >= 0.0f) || !std::isfinite(weight)) {
      negative = true;
      weight = 0.0f;
    }
    sum += double(weight);
  }
  if (negative) ++odd.signs;
  if (!(sum > 0.0)) {
    ++odd.none;
    weights[0] = 1.0f;
    return;
  }
  if (!negative && std::abs(sum - 1.0) > weightTolerance) ++odd.sums;
  for (float& weight : weights) weight = static_cast<float>(double(weight) / sum);
}

void warnOf(const LoadContext& context, const std::string& path, const OddWeights& odd) {
  if (odd.signs > 0)
    context.warn(path,
                 fmt::format("{} vertices have weights below 0 or that are not finite; those are taken as 0",
                             odd.signs));
  if (odd.sums > 0)
    context.warn(path,
                 fmt::format("the weights of {} vertices do not sum up to 1; they are scaled", odd.sums));
  if (odd.none > 0)
    context.warn(path, fmt::format("{} vertices have no weight; they follow their first joint", odd.none));
}

glm::dmat4 bindMatrix(const LoadContext& context, const JsonCursor& accessor, std::span<const float> numbers,
                      std::size_t joint) {
  glm::dmat4 matrix(1.0);
  for (int i = 0; i < 16; ++i) {
    const double number = numbers[16 * joint + static_cast<std::size_t>(i)];
    if (!std::isfinite(number))
      accessor.fail(
          fmt::format("number {} of the matrix of joint {} is {}, expected finite ones", i, joint, number),
          "export the skin again");
    matrix[i / 4][i % 4] = number;
  }
  constexpr double rounding = 1e-5;
  if (std::abs(matrix[0][3]) > rounding || std::abs(matrix[1][3]) > rounding ||
      std::abs(matrix[2][3]) > rounding || std::abs(matrix[3][3] - 1.0) > rounding)
    context.warnings.push_back(
        fmt::format("{}: the last row of the matrix of joint {} is not 0 0 0 1; it is taken as such",
                    accessor.where(), joint));
  matrix[0][3] = matrix[1][3] = matrix[2][3] = 0.0;
  matrix[3][3] = 1.0;
  return matrix;
}

/// Returns the inverse bind matrices. Without them, the joints are bound at the mesh's place.
std::vector<glm::dmat4> readBindMatrices(const LoadContext& context, const JsonCursor& skin,
                                         std::size_t joints) {
  const auto reference = skin.find("inverseBindMatrices");
  if (!reference) return std::vector<glm::dmat4>(joints, glm::dmat4(1.0));
  const std::vector<float> numbers = AccessorReader(context.document, reference->asUnsigned()).floats();
  if (numbers.size() < 16 * joints)
    reference->fail(fmt::format("{} numbers, expected {} for {} joints", numbers.size(), 16 * joints, joints),
                    "export the skin again");
  std::vector<glm::dmat4> matrices;
  for (std::size_t j = 0; j < joints; ++j) matrices.push_back(bindMatrix(context, *reference, numbers, j));
  return matrices;
}

/// Returns nullopt, with a warning, where a joint is not in the scene, because its transform is unknown.
std::optional<Skin> loadSkin(const LoadContext& context, const JsonCursor& json,
                             const std::map<std::size_t, std::size_t>& places) {
  Skin skin;
  skin.name = json.stringOr("name", "");
  const JsonCursor joints = json.at("joints");
  for (std::size_t j = 0; j < joints.arraySize(); ++j) {
    const auto place = places.find(joints.at(j).asUnsigned());
    if (place == places.end()) {
      context.warnings.push_back(fmt::format("{}: node {} is not in the scene; the skin is not applied",
                                             joints.at(j).where(), joints.at(j).asUnsigned()));
      return std::nullopt;
    }
    skin.joints.push_back(place->second);
  }
  const auto matrices = json.find("inverseBindMatrices");
  if (matrices && lacksData(context.document, matrices->asUnsigned())) {
    context.warnings.push_back(
        matrices->where() + ": its data lie in a buffer that the file leaves out; the skin is not applied");
    return std::nullopt;
  }
  skin.inverseBind = readBindMatrices(context, json, skin.joints.size());
  return skin;
}

/// Returns true when every drawn primitive has joints and the skin has all of them.
bool fits(const LoadContext& context, const Mesh& mesh, std::size_t meshIndex, const JsonCursor& node,
          std::size_t joints) {
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
    const Primitive& primitive = mesh.primitives[p];
    if (primitive.triangles.empty()) continue;
    const std::string path = fmt::format("/meshes/{}/primitives/{}/attributes", meshIndex, p);
    if (primitive.influences == 0) {
      context.warnings.push_back(fmt::format("{}: {} has no JOINTS_0 and WEIGHTS_0; the skin is not applied",
                                             node.at("skin").where(), path));
      return false;
    }
    for (std::size_t i = 0; i < primitive.joints.size(); ++i)
      if (primitive.jointWeights[i] > 0.0f && primitive.joints[i] >= joints)
        throw InputError(context.where(fmt::format("{}/JOINTS_{}", path, i % primitive.influences / 4)),
                         fmt::format("vertex {} follows joint {}, expected 0..{}: the joints of skin {}",
                                     i / primitive.influences, primitive.joints[i], joints - 1,
                                     node.at("skin").asUnsigned()),
                         "export the skin again");
  }
  return true;
}

}  // namespace

void loadInfluences(const LoadContext& context, const JsonCursor& json, const std::string& path,
                    Primitive& primitive) {
  readInfluences(context, json.at("attributes"), primitive);
  if (primitive.influences == 0) return;
  OddWeights odd;
  for (std::size_t v = 0; v < primitive.positions.size(); ++v)
    normaliseWeights(
        std::span(primitive.jointWeights).subspan(v * primitive.influences, primitive.influences), odd);
  warnOf(context, path + "/attributes/WEIGHTS_0", odd);
}

SkinLoader::SkinLoader(const LoadContext& context, const std::vector<SceneNode>& nodes)
    : context_(context), nodes_(nodes) {}

int SkinLoader::skinOf(const JsonCursor& node, std::size_t mesh, const Mesh& loaded,
                       std::vector<Skin>& skins) {
  const auto reference = node.find("skin");
  if (!reference) return none;
  const std::size_t index = reference->asUnsigned();
  if (places_.empty())
    for (std::size_t i = 0; i < nodes_.size(); ++i) places_[static_cast<std::size_t>(nodes_[i].node)] = i;
  const auto [known, fresh] = known_.try_emplace(index, none);
  if (fresh) {
    std::optional<Skin> skin = loadSkin(context_, context_.root.at("skins").at(index), places_);
    if (skin) {
      known->second = static_cast<int>(skins.size());
      skins.push_back(*std::move(skin));
    }
  }
  if (known->second == none) return none;
  const std::size_t joints = skins[static_cast<std::size_t>(known->second)].joints.size();
  return fits(context_, loaded, mesh, node, joints) ? known->second : none;
}

}  // namespace prelight
