#include "scene/gltf/texture_source.h"

namespace prelight {

namespace {

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
  for (const char* extension : textureExtensions) check(sourceOf(texture, extension));
}

std::optional<std::size_t> textureImage(const JsonCursor& texture) {
  for (const auto& source : {sourceOf(texture, "EXT_texture_webp"), sourceOf(texture, "EXT_texture_avif"),
                             texture.find("source"), sourceOf(texture, "KHR_texture_basisu")}) {
    if (source) return source->asUnsigned();
  }
  return std::nullopt;
}

}  // namespace prelight
