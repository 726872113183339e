#include "prelight/load.h"

#include <utility>

#include "io/baked_file.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/loader.h"

namespace prelight {

namespace {

LoadedScene loadDocument(GltfDocument document, Warnings warnings) {
  LoadedScene loaded;
  loaded.path = document.path;
  loaded.scene = loadScene(document, warnings);
  loaded.compiled = compileScene(loaded.scene, warnings);
  loaded.document = std::make_shared<const GltfDocument>(std::move(document));
  loaded.warnings = std::move(warnings);
  return loaded;
}

}  // namespace

LoadedScene load(const std::filesystem::path& path, const LoadOptions& options) {
  Warnings warnings;
  GltfDocument document = readGltf(path, warnings, {options.allowOutside});
  return loadDocument(std::move(document), std::move(warnings));
}

LoadedScene load(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                 const LoadOptions& options) {
  Warnings warnings;
  const std::span<const std::uint8_t> text(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  GltfDocument document = parseGltf(text, folder / "memory", warnings, {options.allowOutside});
  return loadDocument(std::move(document), std::move(warnings));
}

LoadedScene loadBuiltin(const std::string& name) { return loadDocument(makeBuiltinScene(name), {}); }

std::optional<Bake> carriedBake(const LoadedScene& scene) {
  return readBake(*scene.document, scene.compiled);
}

}  // namespace prelight
