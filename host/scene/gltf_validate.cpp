#include "scene/gltf_validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "scene/accessor.h"

namespace prelight {

namespace {

constexpr std::array<std::string_view, 12> knownExtensions = {"KHR_lights_punctual",
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
                                                              "KHR_materials_diffuse_transmission"};

bool isKnown(const std::string& extension) {
  return extension == "PRELIGHT_transfer" ||
         std::find(knownExtensions.begin(), knownExtensions.end(), extension) != knownExtensions.end();
}

void validateAsset(const JsonCursor& root) {
  const JsonCursor version = root.at("asset").at("version");
  const std::string& text = version.asString();
  if (text != "2" && !text.starts_with("2.")) {
    version.fail(fmt::format("glTF version \"{}\", expected 2.x", text), "export the scene as glTF 2.0");
  }
}

void validateSparseIndices(const GltfDocument& document, const JsonCursor& accessor, std::size_t index) {
  const AccessorReader reader(document, index);
  const std::vector<std::uint32_t> indices = reader.sparseIndices();
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const JsonCursor where = accessor.at("sparse").at("indices");
    if (indices[i] >= reader.count()) {
      where.fail(fmt::format("sparse index {} is {}, expected 0..{}", i, indices[i], reader.count() - 1));
    }
    if (i > 0 && indices[i] <= indices[i - 1]) {
      where.fail(fmt::format("sparse index {} is {} after {}, expected strictly increasing", i, indices[i],
                             indices[i - 1]));
    }
  }
}

void validateVertexIndices(const GltfDocument& document, const JsonCursor& primitive) {
  const std::size_t accessor = primitive.at("indices").asUnsigned();
  const std::size_t position = primitive.at("attributes").at("POSITION").asUnsigned();
  const std::uint64_t vertices = document.json["accessors"][position].at("count").get<std::uint64_t>();
  const std::vector<std::uint32_t> indices = AccessorReader(document, accessor).unsignedIntegers();
  const auto bad =
      std::find_if(indices.begin(), indices.end(), [&](std::uint32_t i) { return i >= vertices; });
  if (bad != indices.end()) {
    primitive.at("indices").fail(fmt::format("index {} refers to vertex {}, expected 0..{}",
                                             bad - indices.begin(), *bad, vertices - 1));
  }
}

}  // namespace

void validateExtensionLists(const JsonCursor& root, Warnings& warnings) {
  for (const char* list : {"extensionsRequired", "extensionsUsed"}) {
    const auto names = root.find(list);
    if (!names) continue;
    const std::size_t count = names->arraySize();
    for (std::size_t i = 0; i < count; ++i) {
      const JsonCursor name = names->at(i);
      const std::string& extension = name.asString();
      if (isKnown(extension)) continue;
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
  validateAsset(root);
  validateExtensionLists(root, warnings);
  validateBuffers(root);
  validateAccessors(root);
  validateMeshes(root);
  validateCamerasAndLights(root);
  validateNodes(root);
  validateMaterials(root, warnings);
}

void validateBinaryData(const GltfDocument& document) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  root.forEachObject("accessors", [&](const JsonCursor& accessor, std::size_t index) {
    if (accessor.find("sparse")) validateSparseIndices(document, accessor, index);
  });
  // Many primitives may share their accessors: each pair is read once.
  std::set<std::pair<std::uint64_t, std::uint64_t>> checked;
  root.forEachObject("meshes", [&](const JsonCursor& mesh, std::size_t) {
    mesh.forEachObject("primitives", [&](const JsonCursor& primitive, std::size_t) {
      if (!primitive.find("indices") || !primitive.at("attributes").find("POSITION")) return;
      const std::uint64_t indices = primitive.at("indices").asUnsigned();
      const std::uint64_t positions = primitive.at("attributes").at("POSITION").asUnsigned();
      if (checked.emplace(indices, positions).second) validateVertexIndices(document, primitive);
    });
  });
}

}  // namespace prelight
