#include "refine/refined_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "charts/chart_vertices.h"
#include "scene/gltf/accessor.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;
using Parents = std::vector<std::array<std::uint32_t, 2>>;

constexpr int floatType = 5126, unsignedType = 5125;

template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

/// Appends the means of the parents' elements, each of `components` numbers.
void addMeans(const Parents& added, std::size_t components, std::vector<float>& values) {
  values.reserve(values.size() + added.size() * components);
  for (const auto& [a, b] : added)
    for (std::size_t c = 0; c < components; ++c)
      values.push_back(static_cast<float>(
          0.5 * (double(values[a * components + c]) + double(values[b * components + c]))));
}

/// Makes the first three numbers of each new element a unit vector; opposite parents leave the first one's.
void normalizeAdded(const Parents& added, std::size_t components, std::vector<float>& values) {
  const std::size_t first = values.size() / components - added.size();
  for (std::size_t i = 0; i < added.size(); ++i) {
    float* v = &values[(first + i) * components];
    const glm::dvec3 mean(v[0], v[1], v[2]);
    const double length = glm::length(mean);
    const float* parent = &values[added[i][0] * components];
    for (int c = 0; c < 3; ++c) v[c] = length > 1e-6 ? static_cast<float>(mean[c] / length) : parent[c];
    if (components == 4) v[3] = parent[3];
  }
}

void addBounds(const std::vector<float>& values, std::size_t components, Json& accessor) {
  for (const bool largest : {false, true}) {
    Json bound = Json::array();
    for (std::size_t c = 0; c < components; ++c) {
      float most = values[c];
      for (std::size_t i = c; i < values.size(); i += components)
        most = largest ? std::max(most, values[i]) : std::min(most, values[i]);
      bound.push_back(most);
    }
    accessor[largest ? "max" : "min"] = std::move(bound);
  }
}

/// Writes the attributes of one primitive.
class PrimitiveWriter {
 public:
  PrimitiveWriter(const RefinedPrimitive& refined, GltfDocument& document)
      : refined_(refined), document_(document) {}

  void write() {
    Json primitive = document_.json["meshes"][refined_.mesh]["primitives"][refined_.primitive];
    Json& attributes = primitive["attributes"];
    while (attributes.contains(fmt::format("JOINTS_{}", sets_)) &&
           attributes.contains(fmt::format("WEIGHTS_{}", sets_)))
      ++sets_;
    if (sets_ > 0) writeInfluences(attributes);
    for (auto& [name, accessor] : attributes.items())
      if (!isInfluence(name)) accessor = writeAttribute(name, accessor.get<std::size_t>(), false);
    if (primitive.contains("targets"))
      for (Json& target : primitive["targets"])
        for (auto& [name, accessor] : target.items())
          accessor = writeAttribute(name, accessor.get<std::size_t>(), true);
    std::vector<std::uint32_t> indices;
    for (const glm::uvec3& t : refined_.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
    primitive["indices"] =
        appendAccessor(document_, bytesOf(indices), "SCALAR", unsignedType, indices.size());
    primitive.erase("mode");
    document_.json["meshes"][refined_.mesh]["primitives"][refined_.primitive] = std::move(primitive);
  }

 private:
  bool isInfluence(const std::string& name) const {
    return sets_ > 0 && (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_"));
  }

  int append(const std::vector<float>& values, const std::string& type, std::size_t components) {
    return appendAccessor(document_, bytesOf(values), type, floatType, values.size() / components);
  }

  /// Copies members that are not about values from an accessor to the one that replaces it.
  void keepTexts(const Json& replaced, int written) {
    Json& accessor = document_.json["accessors"][static_cast<std::size_t>(written)];
    for (const char* member : {"name", "extensions", "extras"})
      if (replaced.contains(member)) accessor[member] = replaced[member];
  }

  /// Replaces an attribute by an accessor that has just been appended.
  void replace(Json& attribute, int written) {
    const Json replaced = document_.json["accessors"][attribute.get<std::size_t>()];
    keepTexts(replaced, written);
    attribute = written;
  }

  int writeAttribute(const std::string& name, std::size_t accessor, bool isChange) {
    const AccessorReader reader(document_, accessor);
    const std::size_t components = reader.components();
    const bool custom = name.starts_with("_"), isFloat = reader.componentType() == floatType;
    const Json json = document_.json["accessors"][accessor];
    const bool isWhole = custom && !isFloat && !json.value("normalized", false);
    if (isWhole || name.starts_with("_FEATURE_ID_")) return copyFromParents(accessor, reader.count());
    std::vector<float> values = reader.floats(name.starts_with("COLOR_") && !isFloat);
    addMeans(refined_.added, components, values);
    if (!isChange && (name == "NORMAL" || name == "TANGENT"))
      normalizeAdded(refined_.added, components, values);
    const int written = append(values, reader.type(), components);
    keepTexts(json, written);
    if (name == "POSITION")
      addBounds(values, components, document_.json["accessors"][static_cast<std::size_t>(written)]);
    return written;
  }

  /// Numbers that name something have no means: new vertices have those of one parent.
  int copyFromParents(std::size_t accessor, std::size_t count) {
    std::vector<std::uint32_t> source(count);
    std::iota(source.begin(), source.end(), 0u);
    for (const auto& parents : refined_.added) source.push_back(source[parents[0]]);
    return copyVertexAccessor(document_, accessor, source);
  }

  /// Joints of new vertices are those of both parents, as many as there is room for.
  void writeInfluences(Json& attributes) {
    const std::size_t each = 4 * static_cast<std::size_t>(sets_);
    std::vector<std::uint32_t> joints;
    std::vector<float> weights;
    readInfluences(attributes, joints, weights);
    std::map<std::uint32_t, double> mean;
    std::vector<std::pair<double, std::uint32_t>> order;
    for (const auto& parents : refined_.added) {
      mean.clear();
      for (const std::uint32_t parent : parents)
        for (std::size_t k = 0; k < each; ++k)
          mean[joints[parent * each + k]] += 0.5 * double(weights[parent * each + k]);
      order.clear();
      for (const auto& [joint, weight] : mean) order.emplace_back(-weight, joint);
      std::sort(order.begin(), order.end());
      order.resize(std::min(order.size(), each));
      double sum = 0.0;
      for (const auto& [weight, joint] : order) sum -= weight;
      for (std::size_t k = 0; k < each; ++k) {
        const bool used = k < order.size() && order[k].first < 0.0 && sum > 0.0;
        joints.push_back(used ? order[k].second : 0);
        weights.push_back(used ? static_cast<float>(-order[k].first / sum) : 0.0f);
      }
    }
    appendInfluences(joints, weights, attributes);
  }

  /// Reads all sets, [vertex][set][4].
  void readInfluences(const Json& attributes, std::vector<std::uint32_t>& joints,
                      std::vector<float>& weights) const {
    for (int set = 0; set < sets_; ++set) {
      const AccessorReader jointReader(document_,
                                       attributes[fmt::format("JOINTS_{}", set)].get<std::size_t>());
      const AccessorReader weightReader(document_,
                                        attributes[fmt::format("WEIGHTS_{}", set)].get<std::size_t>());
      const std::vector<std::uint32_t> own = jointReader.unsignedIntegers();
      const std::vector<float> ownWeights = weightReader.floats(weightReader.componentType() != floatType);
      const auto each = 4 * static_cast<std::size_t>(sets_);
      joints.resize(jointReader.count() * each);
      weights.resize(jointReader.count() * each);
      for (std::size_t v = 0; v < jointReader.count(); ++v)
        for (std::size_t k = 0; k < 4; ++k) {
          joints[v * each + 4 * static_cast<std::size_t>(set) + k] = own[4 * v + k];
          weights[v * each + 4 * static_cast<std::size_t>(set) + k] = ownWeights[4 * v + k];
        }
    }
  }

  void appendInfluences(const std::vector<std::uint32_t>& joints, const std::vector<float>& weights,
                        Json& attributes) {
    constexpr int shortType = 5123;
    const std::size_t each = 4 * static_cast<std::size_t>(sets_), count = joints.size() / each;
    for (int set = 0; set < sets_; ++set) {
      std::vector<std::uint16_t> ownJoints;
      std::vector<float> ownWeights;
      for (std::size_t v = 0; v < count; ++v)
        for (std::size_t k = 0; k < 4; ++k) {
          const std::size_t at = v * each + 4 * static_cast<std::size_t>(set) + k;
          ownJoints.push_back(static_cast<std::uint16_t>(joints[at]));
          ownWeights.push_back(weights[at]);
        }
      replace(attributes[fmt::format("JOINTS_{}", set)],
              appendAccessor(document_, bytesOf(ownJoints), "VEC4", shortType, count));
      replace(attributes[fmt::format("WEIGHTS_{}", set)], append(ownWeights, "VEC4", 4));
    }
  }

  const RefinedPrimitive& refined_;
  GltfDocument& document_;
  int sets_ = 0;  ///< sets of joints and weights
};

}  // namespace

void writeRefined(std::span<const RefinedPrimitive> primitives, GltfDocument& document) {
  for (const RefinedPrimitive& primitive : primitives) PrimitiveWriter(primitive, document).write();
}

}  // namespace prelight
