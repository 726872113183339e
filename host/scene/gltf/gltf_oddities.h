#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "prelight/error.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// What breaks a rule of glTF that nothing here depends on, in a tree that validateGltf accepts: one warning
/// for each rule, with its first place and the number of others.
void warnOfOddities(const nlohmann::ordered_json& root, const std::string& file, Warnings& warnings);

/// The same of the numbers of a read document's accessors and of its pictures.
void warnOfOddValues(const GltfDocument& document, Warnings& warnings);

/// The oddities so far, by rule.
class Oddities {
 public:
  /// `place` is a JSON path.
  void add(const std::string& rule, const std::string& place);
  void addTo(Warnings& warnings, const std::string& file) const;

 private:
  struct Found {
    std::string rule;
    std::string place;
    std::size_t count = 0;
  };
  std::vector<Found> found_;
};

/// The parts of warnOfOddities: everywhere in the tree, part by part, and in meshes, skins and variants.
void findOddStructure(const nlohmann::ordered_json& root, Oddities& odd);
void findOddParts(const nlohmann::ordered_json& root, Oddities& odd);
void findOddMeshes(const nlohmann::ordered_json& root, Oddities& odd);
void findOddSkins(const nlohmann::ordered_json& root, Oddities& odd);
void findOddVariants(const nlohmann::ordered_json& root, Oddities& odd);

/// Those of warnOfOddValues: of vertices, and of the matrices of skins. `left`: numbers that are still looked
/// at.
void findOddVertices(const GltfDocument& document, std::uint64_t& left, Oddities& odd);
void findOddMatrices(const GltfDocument& document, std::uint64_t& left, Oddities& odd);

/// Calls visit(reader) for an accessor that has data and no more numbers than are left.
void forReadable(const GltfDocument& document, std::uint64_t accessor, std::uint64_t& left,
                 const std::function<void(const AccessorReader&)>& visit);

}  // namespace prelight
