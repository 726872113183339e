#include "export/exported_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* lightMapExtension = "MOZ_lightmap";
constexpr const char* unlitExtension = "KHR_materials_unlit";

Json::json_pointer mappingsOfVariants() {
  return Json::json_pointer("/extensions/KHR_materials_variants/mappings");
}

/// Calls visit(material) for every reference of a primitive to a material; visit may change it.
template <class Visit>
void forEachMaterial(Json& primitive, Visit visit) {
  if (primitive.contains("material")) visit(primitive["material"]);
  if (!hasVariants(primitive)) return;
  for (Json& mapping : primitive[mappingsOfVariants()])
    if (mapping.contains("material")) visit(mapping["material"]);
}

}  // namespace

bool hasVariants(const Json& primitive) { return primitive.contains(mappingsOfVariants()); }

int texCoordSets(const Json& material) {
  int sets = 1;
  for (const auto& member : material.items()) {
    if (member.key() == "extras") continue;
    if (material.is_object() && member.key() == "texCoord")
      sets = std::max(sets, static_cast<int>(unsignedValue(member.value()).value_or(0)) + 1);
    else if (member.value().is_structured())
      sets = std::max(sets, texCoordSets(member.value()));
  }
  return sets;
}

Json ExportedMaterials::made(int original, const MaterialUse& use) const {
  Json material =
      original < 0 ? Json::object() : document_.json["materials"][static_cast<std::size_t>(original)];
  if (use.charted && form_ == ExportForm::LightMap) material.erase("occlusionTexture");
  if (use.charted && !textures_.empty()) {
    const ChartTexture& shown = textures_.at(static_cast<std::size_t>(use.map));
    Json texture = {{"index", shown.texture}, {"texCoord", use.texCoord}};
    if (form_ == ExportForm::Occlusion) {
      material["occlusionTexture"] = std::move(texture);
    } else {
      texture["intensity"] = shown.intensity;
      material["extensions"][lightMapExtension] = std::move(texture);
    }
  }
  // Extras serve importers that read no extensions.
  Json& extras = material["extras"];
  if (use.charted && form_ == ExportForm::LightMap && (extras.is_null() || extras.is_object())) {
    extras["prelight_light_map"] = use.texCoord;
    if (use.oneSided) extras["prelight_two_sides"] = true;
  }
  if (extras.is_null()) material.erase("extras");
  if (use.unlit) material["extensions"][unlitExtension] = Json::object();
  if (use.glows) {
    Json& factor = material["pbrMetallicRoughness"]["baseColorFactor"];
    factor = {1.0, 1.0, 1.0, factor.is_array() ? factor[3] : Json(1.0)};
  }
  if (use.twoSided) material["doubleSided"] = true;
  if (use.oneSided) material.erase("doubleSided");
  return material;
}

int ExportedMaterials::materialFor(int original, const MaterialUse& use) {
  const auto [found, fresh] = made_.try_emplace({original, use}, 0);
  if (fresh) {
    Json& materials = document_.json["materials"];
    found->second = static_cast<int>(materials.size());
    materials.push_back(made(original, use));
  }
  return found->second;
}

void ExportedMaterials::assign(Json& primitive, const MaterialUse& use) {
  if (use == MaterialUse{}) return;
  if (!primitive.contains("material")) primitive["material"] = -1;
  forEachMaterial(primitive, [&](Json& material) { material = materialFor(material.get<int>(), use); });
  if (use.charted && !textures_.empty() && form_ == ExportForm::LightMap)
    useExtensionName(document_.json, lightMapExtension);
  if (use.unlit) useExtensionName(document_.json, unlitExtension);
}

std::vector<AnimatedCopies> ExportedMaterials::settle() {
  Json& root = document_.json;
  if (!root.contains("meshes") || made_.empty()) return {};
  std::set<int> used;
  const auto forAll = [&](auto visit) {
    for (Json& mesh : root["meshes"])
      for (Json& primitive : mesh["primitives"]) forEachMaterial(primitive, visit);
  };
  forAll([&](const Json& material) { used.insert(material.get<int>()); });
  // Materials keep their order; remaining copies are appended.
  const int originals = static_cast<int>(root["materials"].size() - made_.size());
  std::vector<int> place(root["materials"].size());
  for (int i = 0; i < originals; ++i) place[static_cast<std::size_t>(i)] = i;
  Json materials = Json::array();
  for (int i = 0; i < originals; ++i) materials.push_back(root["materials"][static_cast<std::size_t>(i)]);
  std::map<int, Key> keyOf;
  for (const auto& [key, material] : made_) keyOf.emplace(material, key);
  std::vector<AnimatedCopies> copies;
  for (const auto& [material, key] : keyOf) {
    const int original = key.first;
    const bool takes = original >= 0 && used.insert(original).second;
    place[static_cast<std::size_t>(material)] = takes ? original : static_cast<int>(materials.size());
    const Json& copy = root["materials"][static_cast<std::size_t>(material)];
    if (takes) {
      materials[static_cast<std::size_t>(original)] = copy;
    } else {
      if (original >= 0)
        copies.push_back(
            {fmt::format("/materials/{}", original), {fmt::format("/materials/{}", materials.size())}});
      materials.push_back(copy);
    }
  }
  root["materials"] = std::move(materials);
  forAll([&](Json& material) { material = place[material.get<std::size_t>()]; });
  return copies;
}

}  // namespace prelight
