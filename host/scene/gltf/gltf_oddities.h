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

/// Warns of violations of rules of glTF on which nothing here depends, in a tree that validateGltf accepts:
/// one warning per rule, with its first place and the number of others.
void warnOfOddities(const nlohmann::ordered_json& root, const std::string& file, Warnings& warnings);

/// Warns in this way of the numbers of a read document's accessors and of its images.
void warnOfOddValues(const GltfDocument& document, Warnings& warnings);

/// The oddities found so far, by rule.
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

/// The parts of warnOfOddities: general structure, single parts, meshes, skins and variants.
void findOddStructure(const nlohmann::ordered_json& root, Oddities& odd);
void findOddParts(const nlohmann::ordered_json& root, Oddities& odd);
void findOddMeshes(const nlohmann::ordered_json& root, Oddities& odd);
void findOddSkins(const nlohmann::ordered_json& root, Oddities& odd);
void findOddVariants(const nlohmann::ordered_json& root, Oddities& odd);

/// The parts of warnOfOddValues: vertices, and matrices of skins. `left`: number of values that may still be
/// examined.
void findOddVertices(const GltfDocument& document, std::uint64_t& left, Oddities& odd);
void findOddMatrices(const GltfDocument& document, std::uint64_t& left, Oddities& odd);

/// Calls visit(reader) for an accessor that has data and at most `left` numbers.
void forReadable(const GltfDocument& document, std::uint64_t accessor, std::uint64_t& left,
                 const std::function<void(const AccessorReader&)>& visit);

}  // namespace prelight
