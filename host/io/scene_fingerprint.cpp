#include "io/scene_fingerprint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "io/baked_file.h"
#include "io/values/value_reader.h"
#include "scene/gltf/image_decode.h"
#include "scene/gltf/json_cursor.h"
#include "scene/scene_hash.h"
#include "techniques/registry/registry.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

void addTexture(const TextureRef& texture, StateHash& hash) {
  hash.value(texture.image).value(texture.texCoord).value(texture.wrapS).value(texture.wrapT);
  hash.value(texture.filter);
  for (int c = 0; c < 3; ++c) hash.value(texture.transform[c].x).value(texture.transform[c].y);
}

/// Returns whether the alpha of a material's base colour makes holes.
bool hasHoles(const CompiledMaterial& material) { return material.alphaCutoff >= 0.0f || material.blended; }

void addCoverage(const CompiledScene& scene, StateHash& hash) {
  for (const CompiledMaterial& m : scene.materials) {
    hash.value(m.doubleSided).value(m.blended).value(m.alphaCutoff).value(m.alphaFactor);
    if (hasHoles(m)) addTexture(m.baseColorTexture, hash);
  }
}

/// Hashes of images as stored in the file, each computed once.
class ImageHashes {
 public:
  explicit ImageHashes(const GltfDocument& document)
      : document_(document), count_(document.json.contains("images") ? document.json["images"].size() : 0) {}

  void add(const TextureRef& texture, StateHash& hash) {
    if (texture.image >= 0) hash.value(of(static_cast<std::size_t>(texture.image)));
  }

 private:
  std::uint64_t of(std::size_t image) {
    const auto known = known_.find(image);
    if (known != known_.end()) return known->second;
    return known_.emplace(image, made(image)).first->second;
  }

  /// Images that a loader made of others, and unreadable ones, hash as empty.
  std::uint64_t made(std::size_t image) const {
    StateHash hash;
    if (image >= count_) return hash.result();
    try {
      hash.bytes(std::as_bytes(imageBytes(document_, image)));
    } catch (const InputError&) {
    }
    return hash.result();
  }

  const GltfDocument& document_;
  std::size_t count_;
  std::map<std::size_t, std::uint64_t> known_;
};

std::string textOf(const StateHash& hash) { return fmt::format("{:016x}", hash.result()); }

/// Returns hashes of pixels, by the purpose for which materials use them.
Json texturesOf(const GltfDocument& document, const CompiledScene& scene, const BakeSubject& subject) {
  ImageHashes images(document);
  StateHash coverage, colors, scattering, emission;
  for (const CompiledMaterial& m : scene.materials) {
    if (hasHoles(m)) images.add(m.baseColorTexture, coverage);
    if (subject.colors)
      for (const TextureRef& texture : m.albedoTextures()) images.add(texture, colors);
    if (subject.scattering)
      for (const TextureRef& texture : m.textures()) images.add(texture, scattering);
    if (subject.lights) images.add(m.emissionTexture, emission);
  }
  Json textures = {{"coverage", textOf(coverage)}};
  if (subject.colors) textures["materials"] = textOf(colors);
  if (subject.scattering) textures["scattering"] = textOf(scattering);
  if (subject.lights) textures["lights"] = textOf(emission);
  return textures;
}

bool isPosedAsBaked(const Scene& scene, const RecordedChoice& baked) {
  if (scene.moment.has_value() != baked.moment.has_value()) return false;
  return !scene.moment || (scene.moment->animation == baked.moment->animation &&
                           scene.moment->seconds == baked.moment->seconds);
}

/// Returns the parts of a scene that a technique's values depend on.
BakeSubject subjectOf(const SceneUse& use, const BakeInfo& info) {
  const auto runs = [&](Pass pass) {
    return std::any_of(info.plan.passes.begin(), info.plan.passes.end(),
                       [&](const PlannedPass& planned) { return planned.name == pass.name && planned.runs; });
  };
  BakeSubject subject{.lights = use.lights};
  subject.scattering =
      use.scattering || (use.bounces && (runs(Pass::SpecularTransport) || runs(Pass::SubsurfaceTransport)));
  subject.colors = subject.scattering || use.lights || (use.bounces && info.bounces > 0);
  return subject;
}

struct HeldTechnique {
  std::string name;  ///< name for messages
  BakeSubject subject;
};

std::vector<HeldTechnique> heldBy(const Bake& bake, std::size_t vertices) {
  std::vector<HeldTechnique> held;
  for (const Technique& technique : techniques()) {
    std::vector<BakedSummary> summaries;
    if (technique.summarize != nullptr) technique.summarize(bake, vertices, summaries);
    if (summaries.empty()) continue;
    std::string name(technique.name);
    std::replace(name.begin(), name.end(), '_', ' ');
    held.push_back({std::move(name), subjectOf(technique.use, bake.info)});
  }
  return held;
}

/// A member of a fingerprint, also in its `textures` if it has pixels, and its name in messages.
struct Member {
  const char* key;
  const char* part;
  bool BakeSubject::*of;  ///< nullptr: all bakes depend on it
  bool material;
};

constexpr std::array<Member, 5> members = {{{"geometry", "geometry", nullptr, false},
                                            {"coverage", "materials", nullptr, true},
                                            {"materials", "materials", &BakeSubject::colors, true},
                                            {"scattering", "materials", &BakeSubject::scattering, true},
                                            {"lights", "lights", &BakeSubject::lights, false}}};

/// Returns the names of the parts that differ, in the order of `names`.
std::vector<std::string> changedParts(const JsonCursor& baked, const Json& now, const BakeSubject& used,
                                      bool otherMaterials) {
  std::set<std::string> changed;
  const auto differ = [](const JsonCursor& then, const Json& today, const char* key) {
    const std::string hash = then.stringOr(key, "");
    return !hash.empty() && today.contains(key) && hash != today[key].get<std::string>();
  };
  const std::optional<JsonCursor> pixels = baked.find("textures");
  for (const Member& member : members) {
    if ((member.of != nullptr && !(used.*member.of)) || (member.material && otherMaterials)) continue;
    if (differ(baked, now, member.key)) changed.insert(member.part);
    if (pixels && differ(*pixels, now["textures"], member.key)) changed.insert("textures");
  }
  std::vector<std::string> parts;
  for (const char* part : {"geometry", "materials", "textures", "lights"})
    if (changed.contains(part)) parts.emplace_back(part);
  return parts;
}

/// Returns "a", "a and b" or "a, b and c".
std::string listOf(const std::vector<std::string>& names) {
  if (names.size() < 2) return fmt::format("{}", fmt::join(names, ""));
  const std::vector<std::string> first(names.begin(), names.end() - 1);
  return fmt::format("{} and {}", fmt::join(first, ", "), names.back());
}

std::string changeText(const StaleScene& change) {
  return fmt::format("the scene's {} changed after it was baked", listOf(change.parts));
}

std::string staleText(const StaleScene& change) {
  if (change.all) return "its bake does not fit it";
  return fmt::format("{} in its bake {} not fit it", listOf(change.stale),
                     change.stale.size() == 1 ? "does" : "do");
}

}  // namespace

BakeSubject subjectOf(const Bake& bake, std::size_t vertices) {
  BakeSubject all;
  for (const HeldTechnique& technique : heldBy(bake, vertices)) {
    all.colors |= technique.subject.colors;
    all.scattering |= technique.subject.scattering;
    all.lights |= technique.subject.lights;
  }
  return all;
}

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

Json fingerprintOf(const GltfDocument& document, const CompiledScene& scene, const BakeSubject& subject) {
  StateHash geometry, coverage, materials, scattering, lights;
  addGeometry(scene, geometry);
  for (int c = 0; c < 3; ++c) geometry.value(scene.origin[c]);
  addCoverage(scene, coverage);
  addMaterials(scene, materials);
  for (const CompiledMaterial& material : scene.materials) addMaterial(material, scattering);
  for (const Light& light : scene.lights) addLight(light, lights);
  Json fingerprint = {{"geometry", textOf(geometry)}, {"coverage", textOf(coverage)}};
  if (subject.colors) fingerprint["materials"] = textOf(materials);
  if (subject.scattering) fingerprint["scattering"] = textOf(scattering);
  if (subject.lights) fingerprint["lights"] = textOf(lights);
  fingerprint["textures"] = texturesOf(document, scene, subject);
  return fingerprint;
}

std::optional<StaleScene> changedSinceBake(const BakedScene& baked, BakeSubject used) {
  const std::string file = baked.document.path.string();
  const auto extension = transferExtension(JsonCursor(file, baked.document.json));
  const auto then = extension ? extension->find("fingerprint") : std::nullopt;
  const RecordedChoice choice = readRecordedChoice(baked.document);
  if (!then || !isPosedAsBaked(baked.scene, choice)) return std::nullopt;
  // Earlier versions wrote a single hash of materials for all bakes.
  const bool earlier = !then->find("coverage");
  const bool otherMaterials = baked.scene.variant != choice.variant;
  const auto changed = [&](BakeSubject subject, const Json& now) {
    subject.colors |= earlier;
    return changedParts(*then, now, subject, otherMaterials);
  };
  const std::vector<HeldTechnique> held = heldBy(baked.bake, baked.compiled.vertexCount());
  const Json now = fingerprintOf(baked.document, baked.compiled, {true, true, true});
  StaleScene change{.parts = changed(used, now)};
  if (change.parts.empty()) return std::nullopt;
  for (const HeldTechnique& technique : held)
    if (!changed(technique.subject, now).empty()) change.stale.push_back(technique.name);
  change.all = change.stale.size() == held.size();
  return change;
}

std::optional<StaleScene> changedSinceBake(const BakedScene& baked) {
  return changedSinceBake(baked, subjectOf(baked.bake, baked.compiled.vertexCount()));
}

std::string textOf(const StaleScene& change) {
  return fmt::format("{}: {}", changeText(change), staleText(change));
}

}  // namespace prelight
