#include "prelight/load.h"

#include <utility>

#include "io/baked_file.h"
#include "library/open_scene.h"
#include "scene/builtin/builtin.h"

namespace prelight {

LoadedScene load(const std::filesystem::path& path, const LoadOptions& options) {
  return loadDocument(
      [&](Warnings& warnings) { return readGltf(path, warnings, {.allowOutside = options.allowOutside}); },
      options);
}

LoadedScene load(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                 const LoadOptions& options) {
  const std::span<const std::uint8_t> text(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  return loadDocument(
      [&](Warnings& warnings) {
        return parseGltf(text, folder / "memory", warnings, {options.allowOutside});
      },
      options);
}

LoadedScene loadBuiltin(const std::string& name) {
  return loadDocument([&](Warnings&) { return makeBuiltinScene(name); }, {});
}

std::optional<Bake> carriedBake(const LoadedScene& scene) {
  return readBake(*scene.document, scene.compiled);
}

}  // namespace prelight
