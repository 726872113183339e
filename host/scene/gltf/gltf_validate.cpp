#include "scene/gltf/gltf_validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "scene/gltf/accessor.h"

namespace prelight {

namespace {

constexpr std::array<std::string_view, 28> knownExtensions = {"KHR_lights_punctual",
                                                              "KHR_materials_emissive_strength",
                                                              "KHR_materials_transmission",
                                                              "KHR_materials_volume",
                                                              "KHR_materials_ior",
                                                              "KHR_materials_specular",
                                                              "KHR_materials_unlit",
                                                              "KHR_mesh_quantization",
                                                              "KHR_texture_transform",
                                                              "EXT_mesh_gpu_instancing",
                                                              "KHR_materials_pbrSpecularGlossiness",
                                                              "KHR_materials_diffuse_transmission",
                                                              "KHR_materials_clearcoat",
                                                              "KHR_materials_sheen",
                                                              "KHR_materials_variants",
                                                              "KHR_animation_pointer",
                                                              "EXT_lights_image_based",
                                                              "EXT_lights_ies",
                                                              "KHR_draco_mesh_compression",
                                                              "EXT_meshopt_compression",
                                                              "KHR_meshopt_compression",
                                                              "EXT_texture_webp",
                                                              "EXT_texture_avif",
                                                              "KHR_texture_basisu",
                                                              "KHR_materials_anisotropy",
                                                              "KHR_materials_iridescence",
                                                              "KHR_materials_dispersion",
                                                              "KHR_materials_volume_scatter"};

/// Returns the y of "2.y", at most a million; nullopt for anything else.
std::optional<std::uint64_t> minorVersion(const std::string& text) {
  constexpr std::string_view major = "2.";
  constexpr std::size_t digits = 6;
  if (text == "2") return 0;
  if (!text.starts_with(major) || text.size() == major.size() || text.size() > major.size() + digits)
    return std::nullopt;
  std::uint64_t minor = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + major.size(), end, minor);
  return error == std::errc() && stop == end ? std::optional(minor) : std::nullopt;
}

void validateAsset(const JsonCursor& root, Warnings& warnings) {
  const JsonCursor version = root.at("asset").at("version");
  const std::string& text = version.asString();
  if (text != "2" && !text.starts_with("2.")) {
    version.fail(fmt::format("glTF version \"{}\", expected 2.x", text), "export the scene as glTF 2.0");
  }
  const auto least = root.at("asset").find("minVersion");
  if (!least) return;
  const std::optional<std::uint64_t> minor = minorVersion(text);
  const std::optional<std::uint64_t> leastMinor = minorVersion(least->asString());
  if (!leastMinor)
    least->fail(fmt::format("the file asks for glTF \"{}\", expected 2.x at most", least->asString()),
                "export the scene as glTF 2.0");
  if (minor && *leastMinor > *minor)
    least->fail(fmt::format("the file asks for glTF \"{}\" and says to be \"{}\"", least->asString(), text));
  if (*leastMinor > 0)
    warnings.push_back(
        fmt::format("{}: the file asks for glTF {}, it is read as 2.0", least->where(), least->asString()));
}

void validateVertexIndices(const GltfDocument& document, const JsonCursor& primitive) {
  const std::size_t accessor = primitive.at("indices").asUnsigned();
  const std::size_t position = primitive.at("attributes").at("POSITION").asUnsigned();
  const std::uint64_t vertices = AccessorReader(document, position).count();
  const std::vector<std::uint32_t> indices = AccessorReader(document, accessor).unsignedIntegers();
  const auto bad =
      std::find_if(indices.begin(), indices.end(), [&](std::uint32_t i) { return i >= vertices; });
  if (bad != indices.end()) {
    primitive.at("indices").fail(fmt::format("index {} refers to vertex {}, expected 0..{}",
                                             bad - indices.begin(), *bad, vertices - 1));
  }
}

}  // namespace

bool isKnownExtension(const std::string& extension) {
  return extension == "PRELIGHT_transfer" ||
         std::find(knownExtensions.begin(), knownExtensions.end(), extension) != knownExtensions.end();
}

void validateExtensionLists(const JsonCursor& root, Warnings& warnings) {
  for (const char* list : {"extensionsRequired", "extensionsUsed"}) {
    const auto names = root.find(list);
    if (!names) continue;
    const std::size_t count = names->arraySize();
    for (std::size_t i = 0; i < count; ++i) {
      const JsonCursor name = names->at(i);
      const std::string& extension = name.asString();
      if (isKnownExtension(extension)) continue;
      if (list == std::string_view("extensionsRequired")) {
        name.fail(fmt::format("the file requires extension {}, which is not supported", extension),
                  "export without it");
      }
      warnings.push_back(
          fmt::format("{}: extension {} is not supported and is ignored", name.where(), extension));
    }
  }
}

void validateGltf(const JsonCursor& root, Warnings& warnings) {
  root.expectObject();
  const GltfUse use = findUse(root.value());
  validateAsset(root, warnings);
  validateExtensionLists(root, warnings);
  validateBuffers(root, use, warnings);
  validateAccessors(root, use, warnings);
  validateMeshes(root);
  validateCamerasAndLights(root, use, warnings);
  validateNodes(root);
  validateSkins(root, use, warnings);
  validateMaterials(root, use, warnings);
  warnOfMorphs(root, warnings);
}

void validateBinaryData(const GltfDocument& document) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  // Sparse accessors are checked by their readers.
  for (const std::size_t index : findUse(document.json).accessors) {
    if (index < root.countOf("accessors") && root.at("accessors").at(index).find("sparse") &&
        !lacksData(document, index))
      (void)AccessorReader(document, index);
  }
  // Many primitives may share their accessors, so each pair is read once.
  std::set<std::pair<std::uint64_t, std::uint64_t>> checked;
  root.forEachObject("meshes", [&](const JsonCursor& mesh, std::size_t) {
    mesh.forEachObject("primitives", [&](const JsonCursor& primitive, std::size_t) {
      if (!primitive.find("indices") || !primitive.at("attributes").find("POSITION")) return;
      if (lacksData(document, primitive)) return;
      const std::uint64_t indices = primitive.at("indices").asUnsigned();
      const std::uint64_t positions = primitive.at("attributes").at("POSITION").asUnsigned();
      if (checked.emplace(indices, positions).second) validateVertexIndices(document, primitive);
    });
  });
}

}  // namespace prelight
