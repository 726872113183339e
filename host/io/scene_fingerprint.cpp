#include "io/scene_fingerprint.h"

#include <fmt/format.h>

#include "io/baked_file.h"
#include "io/values/transfer_extension.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

void addTexture(const TextureRef& texture, StateHash& hash) {
  hash.value(texture.image).value(texture.texCoord).value(texture.wrapS).value(texture.wrapT);
  hash.value(texture.filter);
  for (int c = 0; c < 3; ++c) hash.value(texture.transform[c].x).value(texture.transform[c].y);
}

bool isPosedAsBaked(const Scene& scene, const RecordedChoice& baked) {
  if (scene.moment.has_value() != baked.moment.has_value()) return false;
  return !scene.moment || (scene.moment->animation == baked.moment->animation &&
                           scene.moment->seconds == baked.moment->seconds);
}

}  // namespace

void addGeometry(const CompiledScene& scene, StateHash& hash) {
  hash.values(scene.positions).values(scene.normals).values(scene.colors);
  hash.values(scene.texCoords).values(scene.texCoords1);
  hash.values(scene.triangles).values(scene.triangleMaterials).values(scene.triangleFlat);
}

void addMaterials(const CompiledScene& scene, StateHash& hash) {
  for (const CompiledMaterial& m : scene.materials) {
    for (int c = 0; c < 3; ++c) hash.value(m.albedo[c]);
    for (int c = 0; c < 3; ++c) hash.value(m.emission[c]);
    for (int c = 0; c < 3; ++c) hash.value(m.diffuseTransmission[c]);
    hash.value(m.doubleSided).value(m.blended);
    hash.value(m.alphaCutoff).value(m.alphaFactor).value(m.metallic).value(m.transmission);
    for (const TextureRef& texture : m.albedoTextures()) addTexture(texture, hash);
  }
}

Json fingerprintOf(const CompiledScene& scene) {
  StateHash geometry, materials;
  addGeometry(scene, geometry);
  for (int c = 0; c < 3; ++c) geometry.value(scene.origin[c]);
  addMaterials(scene, materials);
  return {{"geometry", fmt::format("{:016x}", geometry.result())},
          {"materials", fmt::format("{:016x}", materials.result())}};
}

std::optional<std::string> changedSinceBake(const GltfDocument& document, const Scene& scene,
                                            const CompiledScene& compiled) {
  const std::string file = document.path.string();
  const auto extension = transferExtension(JsonCursor(file, document.json));
  const auto baked = extension ? extension->find("fingerprint") : std::nullopt;
  const RecordedChoice choice = readRecordedChoice(document);
  if (!baked || !isPosedAsBaked(scene, choice)) return std::nullopt;
  const Json now = fingerprintOf(compiled);
  std::string changed;
  for (const char* part : {"geometry", "materials"}) {
    const std::string then = baked->stringOr(part, "");
    const bool onPurpose = part == std::string_view("materials") && scene.variant != choice.variant;
    if (then.empty() || then == now[part] || onPurpose) continue;
    changed += (changed.empty() ? "" : " and ") + std::string(part);
  }
  return changed.empty() ? std::nullopt : std::optional(changed);
}

}  // namespace prelight
