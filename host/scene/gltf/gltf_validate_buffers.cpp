#include <fmt/format.h>

#include "scene/gltf/accessor.h"
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

}  // namespace prelight
