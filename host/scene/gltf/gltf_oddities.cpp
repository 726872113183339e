#include "scene/gltf/gltf_oddities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

/// A value's path from the root, as a linked list; text is made of it only for oddities.
struct Step {
  const Step* parent = nullptr;
  std::string_view key;   ///< key of an object's member
  std::size_t index = 0;  ///< index of an array's element, if there is no key

  std::string path() const {
    if (parent == nullptr) return {};
    return parent->path() + "/" + (key.empty() ? std::to_string(index) : std::string(key));
  }
  /// Returns the path with a star for each index.
  std::string pattern() const {
    if (parent == nullptr) return {};
    return parent->pattern() + "/" + (key.empty() ? std::string("*") : std::string(key));
  }
};

/// Places in which an extension may occur. The first entry whose text is a prefix of the name applies.
struct Placement {
  std::string_view extension;
  std::array<std::string_view, 2> patterns;
};

constexpr std::string_view nowhere = "-";
constexpr std::string_view anyTexture = "Texture";
constexpr std::string_view rootPattern = "";
constexpr std::array<Placement, 12> placements = {
    {{"KHR_materials_variants", {rootPattern, "/meshes/*/primitives/*"}},
     {"KHR_materials_", {"/materials/*", nowhere}},
     {"KHR_lights_punctual", {rootPattern, "/nodes/*"}},
     {"EXT_lights_ies", {rootPattern, "/nodes/*"}},
     {"KHR_texture_transform", {anyTexture, nowhere}},
     {"KHR_texture_basisu", {"/textures/*", nowhere}},
     {"EXT_texture_", {"/textures/*", nowhere}},
     {"KHR_draco_mesh_compression", {"/meshes/*/primitives/*", nowhere}},
     {"KHR_meshopt_compression", {"/buffers/*", "/bufferViews/*"}},
     {"EXT_meshopt_compression", {"/buffers/*", "/bufferViews/*"}},
     {"KHR_mesh_quantization", {nowhere, nowhere}},
     {"KHR_node_visibility", {"/nodes/*", nowhere}}}};

bool mayStand(std::string_view extension, const std::string& pattern) {
  const auto placement = std::find_if(placements.begin(), placements.end(),
                                      [&](const Placement& p) { return extension.starts_with(p.extension); });
  if (placement == placements.end()) return true;
  return std::any_of(placement->patterns.begin(), placement->patterns.end(), [&](std::string_view allowed) {
    return allowed == anyTexture ? pattern.ends_with(anyTexture) : pattern == allowed;
  });
}

class StructureWalk {
 public:
  StructureWalk(const Json& root, Oddities& odd) : odd_(odd) {
    const auto names = root.find("extensionsUsed");
    if (names == root.end()) return;
    for (const Json& name : *names) {
      if (name.is_string()) used_.insert(name.get<std::string>());
    }
  }

  void visit(const Json& value, const Step& step) {
    if (value.is_array()) {
      if (value.empty()) odd_.add("an empty array, expected one element at least", step.path());
      for (std::size_t i = 0; i < value.size() && value[0].is_structured(); ++i)
        visit(value[i], {&step, {}, i});
    } else if (value.is_object()) {
      for (auto member = value.begin(); member != value.end(); ++member) {
        if (member.key() == "extras") continue;
        const Step next{&step, member.key(), 0};
        if (member.key() == "extensions") {
          visitExtensions(member.value(), next);
        } else {
          visit(member.value(), next);
        }
      }
    }
  }

 private:
  void visitExtensions(const Json& extensions, const Step& step) {
    if (!extensions.is_object()) return odd_.add("extensions that are no object", step.path());
    const std::string pattern = step.parent->pattern();
    for (auto member = extensions.begin(); member != extensions.end(); ++member) {
      const Step next{&step, member.key(), 0};
      if (!used_.contains(member.key()))
        odd_.add("an extension that extensionsUsed does not list", next.path());
      if (!member.value().is_object()) {
        odd_.add("an extension that is no object", next.path());
      } else if (!mayStand(member.key(), pattern)) {
        odd_.add("an extension that has no place here; it is ignored", next.path());
      } else {
        visit(member.value(), next);
      }
    }
  }

  Oddities& odd_;
  std::set<std::string> used_;
};

}  // namespace

void Oddities::add(const std::string& rule, const std::string& place) {
  const auto known =
      std::find_if(found_.begin(), found_.end(), [&](const Found& f) { return f.rule == rule; });
  if (known != found_.end()) {
    ++known->count;
  } else {
    found_.push_back({rule, place, 1});
  }
}

void Oddities::addTo(Warnings& warnings, const std::string& file) const {
  for (const Found& found : found_) {
    std::string text = fmt::format("{}: {}: {}", file, found.place.empty() ? "/" : found.place, found.rule);
    if (found.count > 1) text += fmt::format("; also in {} more places", found.count - 1);
    warnings.push_back(std::move(text));
  }
}

void findOddStructure(const Json& root, Oddities& odd) { StructureWalk(root, odd).visit(root, {}); }

void warnOfOddities(const Json& root, const std::string& file, Warnings& warnings) {
  Oddities odd;
  findOddStructure(root, odd);
  findOddParts(root, odd);
  findOddMeshes(root, odd);
  findOddSkins(root, odd);
  findOddVariants(root, odd);
  odd.addTo(warnings, file);
}

}  // namespace prelight
