#include "scene/gltf/texture_source.h"

#include <algorithm>
#include <string>

namespace prelight {

namespace {

constexpr const char* basisExtension = "KHR_texture_basisu";

std::optional<JsonCursor> sourceOf(const JsonCursor& texture, const char* extension) {
  const auto extensions = texture.find("extensions");
  const auto found = extensions ? extensions->find(extension) : std::nullopt;
  return found ? found->find("source") : std::nullopt;
}

}  // namespace

void validateTextureSource(const JsonCursor& root, const JsonCursor& texture) {
  const auto check = [&](const std::optional<JsonCursor>& source) {
    if (source) source->asIndex(root.countOf("images"), "image");
  };
  check(texture.find("source"));
  for (const char* extension : decodedTextureExtensions) check(sourceOf(texture, extension));
}

std::optional<std::size_t> textureImage(const JsonCursor& texture, Warnings& warnings) {
  for (const char* extension : decodedTextureExtensions) {
    if (const auto source = sourceOf(texture, extension)) return source->asUnsigned();
  }
  const auto basis = sourceOf(texture, basisExtension);
  const auto source = texture.find("source");
  if (!basis) return source ? std::optional<std::size_t>(source->asUnsigned()) : std::nullopt;
  if (!source)
    basis->fail("the texture is of KHR_texture_basisu alone, and KTX2 is not decoded here",
                "convert it with `gltf-transform ktxdecompress IN.glb OUT.glb`, or export the scene with "
                "PNG, JPEG or "
                "WebP");
  const std::string warning =
      basis->where() + ": KTX2 is not decoded here; the texture's other picture is used";
  // Many materials may show the texture.
  if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  return source->asUnsigned();
}

}  // namespace prelight
