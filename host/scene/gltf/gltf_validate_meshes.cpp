#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "scene/gltf/draco_primitives.h"
#include "scene/gltf/gltf_validate.h"

namespace prelight {

namespace {

constexpr std::uint64_t uint8 = 5121;
constexpr std::uint64_t uint16 = 5123;
constexpr std::uint64_t uint32 = 5125;

/// Permitted types of an attribute. Prelight reads no other attributes and only checks their indices.
struct AttributeRule {
  std::string_view prefix;
  std::array<std::string_view, 2> types;
};

constexpr std::array<AttributeRule, 7> attributeRules = {{{"POSITION", {"VEC3", "VEC3"}},
                                                          {"NORMAL", {"VEC3", "VEC3"}},
                                                          {"TANGENT", {"VEC4", "VEC4"}},
                                                          {"TEXCOORD_", {"VEC2", "VEC2"}},
                                                          {"COLOR_", {"VEC3", "VEC4"}},
                                                          {"JOINTS_", {"VEC4", "VEC4"}},
                                                          {"WEIGHTS_", {"VEC4", "VEC4"}}}};

/// The rule for tangents of a morph target, which do not contain the sign.
constexpr AttributeRule tangentOfTarget = {"TANGENT", {"VEC3", "VEC3"}};

/// Returns the rule of an attribute, or nullptr for attributes that Prelight does not read.
const AttributeRule* ruleOf(const std::string& name) {
  const auto rule = std::find_if(attributeRules.begin(), attributeRules.end(),
                                 [&](const AttributeRule& r) { return name.starts_with(r.prefix); });
  return rule == attributeRules.end() ? nullptr : &*rule;
}

void validateAttributeType(const JsonCursor& attribute, const std::string& name, const AttributeRule& rule,
                           const JsonCursor& accessor) {
  const std::string type = accessor.at("type").asString();
  if (type != rule.types[0] && type != rule.types[1]) {
    attribute.fail(fmt::format("expected an accessor of type {}, got {}", rule.types[1], type));
  }
  const std::uint64_t component = accessor.at("componentType").asUnsigned();
  if (name.starts_with("JOINTS_") && component != uint8 && component != uint16)
    attribute.fail(fmt::format("expected joints of component type 5121 or 5123, got {}", component));
  if (component == uint32) {  // 8 and 16 bits are normalised or permitted by KHR_mesh_quantization
    attribute.fail(fmt::format("component type {} does not fit {}", component, name));
  }
}

/// Checks every attribute and returns the common number of vertices of those that are read.
std::optional<std::uint64_t> validateAttributes(const JsonCursor& root, const JsonCursor& attributes,
                                                bool ofTarget = false) {
  attributes.expectObject();
  const std::size_t accessors = root.countOf("accessors");
  std::optional<std::uint64_t> vertices;
  std::string first;
  attributes.forEachMember([&](const JsonCursor& attribute, const std::string& name) {
    const std::size_t index = attribute.asIndex(accessors, "accessor");
    const AttributeRule* rule = ofTarget && name == "TANGENT" ? &tangentOfTarget : ruleOf(name);
    if (rule == nullptr) return;
    const JsonCursor accessor = root.at("accessors").at(index);
    validateAttributeType(attribute, name, *rule, accessor);
    const std::uint64_t count = accessor.at("count").asUnsigned();
    if (!vertices) {
      vertices = count;
      first = name;
    } else if (count != *vertices) {
      attribute.fail(fmt::format("{} vertices, but {} has {}", count, first, *vertices));
    }
  });
  return vertices;
}

/// Checks that every set of joints has its weights.
void validateInfluences(const JsonCursor& attributes) {
  std::set<std::string> joints, weights;  // the ends of their names
  attributes.forEachMember([&](const JsonCursor&, const std::string& name) {
    if (name.starts_with("JOINTS_")) joints.insert(name.substr(7));
    if (name.starts_with("WEIGHTS_")) weights.insert(name.substr(8));
  });
  const auto requireBeside = [&](const std::set<std::string>& sets, const char* own,
                                 const std::set<std::string>& others, const char* other) {
    for (const std::string& set : sets)
      if (!others.contains(set))
        attributes.at(own + set).fail(fmt::format("there is no {}{} beside it", other, set),
                                      "export the skin again");
  };
  requireBeside(joints, "JOINTS_", weights, "WEIGHTS_");
  requireBeside(weights, "WEIGHTS_", joints, "JOINTS_");
}

void validateIndices(const JsonCursor& root, const JsonCursor& indices) {
  const JsonCursor accessor = root.at("accessors").at(indices.asIndex(root.countOf("accessors"), "accessor"));
  const std::uint64_t component = accessor.at("componentType").asUnsigned();
  if (component != 5121 && component != 5123 && component != 5125) {
    indices.fail(
        fmt::format("expected unsigned integers (5121, 5123, 5125), got component type {}", component));
  }
  if (accessor.at("type").asString() != "SCALAR") {
    indices.fail("expected an accessor of type SCALAR, got " + accessor.at("type").asString());
  }
}

void validatePrimitive(const JsonCursor& root, const JsonCursor& primitive) {
  const JsonCursor attributes = primitive.at("attributes");
  const auto vertices = validateAttributes(root, attributes);
  validateInfluences(attributes);
  if (const auto indices = primitive.find("indices")) validateIndices(root, *indices);
  if (const auto material = primitive.find("material"))
    material->asIndex(root.countOf("materials"), "material");
  if (const auto mode = primitive.find("mode"); mode && mode->asUnsigned() > 6) {
    mode->fail(fmt::format("expected 0..6, got {}", mode->asUnsigned()));
  }
  validateDraco(root, primitive);
  primitive.forEachObject("targets", [&](const JsonCursor& target, std::size_t) {
    const auto count = validateAttributes(root, target, true);
    if (count && vertices && *count != *vertices) {
      target.fail(fmt::format("a morph target of {} vertices for {}", *count, *vertices));
    }
  });
}

}  // namespace

void validateMeshes(const JsonCursor& root) {
  root.forEachObject("meshes", [&](const JsonCursor& mesh, std::size_t) {
    mesh.stringOr("name", "");
    mesh.at("primitives").arraySize();
    mesh.forEachObject("primitives",
                       [&](const JsonCursor& primitive, std::size_t) { validatePrimitive(root, primitive); });
  });
}

}  // namespace prelight
