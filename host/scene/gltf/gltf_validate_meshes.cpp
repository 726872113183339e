#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "scene/gltf/accessor.h"
#include "scene/gltf/draco_primitives.h"
#include "scene/gltf/gltf_validate.h"
#include "scene/gltf/meshopt_views.h"

namespace prelight {

namespace {

/// An accessor without a buffer view costs no bytes in the file, so its size needs a limit of its own.
constexpr std::uint64_t maxZeroElements = std::uint64_t{1} << 24;

std::uint64_t positive(const JsonCursor& object, const char* key) {
  const JsonCursor member = object.at(key);
  const std::uint64_t value = member.asUnsigned();
  if (value == 0) member.fail("expected a positive integer, got 0");
  return value;
}

void validateView(const JsonCursor& root, const JsonCursor& view) {
  const std::size_t buffer = view.at("buffer").asIndex(root.countOf("buffers"), "buffer");
  const std::uint64_t bufferBytes = root.at("buffers").at(buffer).at("byteLength").asUnsigned();
  const std::uint64_t offset = view.unsignedOr("byteOffset", 0);
  const std::uint64_t length = positive(view, "byteLength");
  if (offset > bufferBytes || length > bufferBytes - offset) {
    view.fail(fmt::format("{} bytes from offset {} reach beyond buffer {} of {} bytes", length, offset,
                          buffer, bufferBytes));
  }
  if (const auto stride = view.find("byteStride")) {
    const std::uint64_t bytes = stride->asUnsigned();
    if (bytes < 4 || bytes > 252 || bytes % 4 != 0) {
      stride->fail(fmt::format("expected a multiple of 4 in 4..252, got {}", bytes));
    }
  }
  validateMeshopt(root, view);
}

/// The size of an element in its buffer view.
struct ElementSize {
  std::uint64_t bytes = 0;      ///< distance between elements, if the view has no stride of its own
  std::uint64_t lastBytes = 0;  ///< of the last element: the padding of a matrix's last column may be missing
};

/// Checks that the `count` elements which `holder` (an accessor, or a part of a sparse one) reads lie in its
/// buffer view.
void validateRange(const JsonCursor& root, const JsonCursor& holder, std::uint64_t count,
                   const ElementSize& element, bool strided) {
  const std::uint64_t bytes = element.bytes;
  const std::uint64_t last = element.lastBytes;
  const std::size_t index = holder.at("bufferView").asIndex(root.countOf("bufferViews"), "buffer view");
  const JsonCursor view = root.at("bufferViews").at(index);
  validateBufferView(root, view);
  const std::uint64_t length = view.at("byteLength").asUnsigned();
  const std::uint64_t offset = holder.unsignedOr("byteOffset", 0);
  const std::uint64_t stride = strided ? view.unsignedOr("byteStride", bytes) : bytes;
  if (!strided && view.find("byteStride")) {
    holder.fail(fmt::format("buffer view {} of a sparse accessor must not have a byteStride", index));
  }
  if (stride < bytes) {
    holder.fail(fmt::format("elements of {} bytes do not fit the byteStride {} of buffer view {}", bytes,
                            stride, index));
  }
  const bool fits =
      offset <= length && last <= length - offset && count - 1 <= (length - offset - last) / stride;
  if (!fits) {
    holder.fail(fmt::format(
        "{} elements of {} bytes, {} apart, from offset {} reach beyond buffer view {} of {} bytes", count,
        bytes, stride, offset, index, length));
  }
}

void validateSparse(const JsonCursor& root, const JsonCursor& sparse, std::uint64_t accessorCount,
                    const ElementSize& element) {
  const std::uint64_t count = positive(sparse, "count");
  if (count > accessorCount) {
    sparse.at("count").fail(fmt::format("{} substitutes for {} elements", count, accessorCount));
  }
  const JsonCursor indices = sparse.at("indices");
  const JsonCursor type = indices.at("componentType");
  const std::uint64_t componentType = type.asUnsigned();
  if (componentType != 5121 && componentType != 5123 && componentType != 5125) {
    type.fail(fmt::format("expected 5121, 5123 or 5125, got {}", componentType));
  }
  const std::uint64_t indexBytes = componentBytes(componentType);
  validateRange(root, indices, count, {indexBytes, indexBytes}, false);
  validateRange(root, sparse.at("values"), count, element, false);
}

}  // namespace

void validateBufferView(const JsonCursor& root, const JsonCursor& view) {
  view.expectObject();
  validateView(root, view);
}

void validateAccessor(const JsonCursor& root, const JsonCursor& accessor, bool filledLater) {
  const JsonCursor componentType = accessor.at("componentType");
  if (componentBytes(componentType.asUnsigned()) == 0) {
    componentType.fail(
        fmt::format("expected one of 5120..5123, 5125, 5126, got {}", componentType.asUnsigned()));
  }
  const JsonCursor type = accessor.at("type");
  if (componentCount(type.asString()) == 0) {
    type.fail(fmt::format("expected SCALAR, VEC2..VEC4 or MAT2..MAT4, got \"{}\"", type.asString()));
  }
  accessor.boolOr("normalized", false);
  const std::uint64_t count = positive(accessor, "count");
  const std::uint64_t padded = elementBytes(type.asString(), componentType.asUnsigned());
  const ElementSize element{padded, padded - columnPadding(type.asString(), componentType.asUnsigned())};
  if (accessor.find("bufferView")) {
    validateRange(root, accessor, count, element, true);
  } else if (count > maxZeroElements && !filledLater) {
    accessor.at("count").fail(
        fmt::format("{} elements without a buffer view, expected at most {}", count, maxZeroElements));
  }
  for (const char* limit : {"min", "max"}) {
    if (const auto values = accessor.find(limit)) values->expectNumbers(componentCount(type.asString()));
  }
  if (const auto sparse = accessor.find("sparse")) validateSparse(root, *sparse, count, element);
}

void validateBuffers(const JsonCursor& root, const GltfUse& use, Warnings& warnings) {
  root.forEachObject("buffers", [&](const JsonCursor& buffer, std::size_t index) {
    checkPart(use.buffers.contains(index), warnings, [&] {
      buffer.at("byteLength").asUnsigned();
      buffer.stringOr("uri", "");
    });
  });
  root.forEachObject("bufferViews", [&](const JsonCursor& view, std::size_t index) {
    checkPart(use.bufferViews.contains(index), warnings, [&] { validateBufferView(root, view); });
  });
}

void validateAccessors(const JsonCursor& root, const GltfUse& use, Warnings& warnings) {
  root.forEachObject("accessors", [&](const JsonCursor& accessor, std::size_t index) {
    checkPart(use.accessors.contains(index), warnings,
              [&] { validateAccessor(root, accessor, use.dracoAccessors.contains(index)); });
  });
}

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
