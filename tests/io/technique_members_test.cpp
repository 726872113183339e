#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <string>

#include "charts/make_light_map_layout.h"
#include "encodings/registry/registry.h"
#include "io/baked_file.h"
#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"
#include "techniques/light_map/light_map_file.h"
#include "techniques/registry/registry.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::set<std::string>;

/// Members that the schema describes of a primitive's entry, or of the root's extension.
Json schemaOf(const char* definition) {
  std::ifstream in(std::string(PRELIGHT_SOURCE_DIR) + "/docs/PRELIGHT_transfer.schema.json");
  const Json schema = Json::parse(in);
  return schema["$defs"][definition]["properties"];
}

Names membersOf(const Json& object);

Names membersOfSchema(const char* definition) { return membersOf(schemaOf(definition)); }

Names membersOf(const Json& object) {
  Names names;
  for (const auto& member : object.items()) names.insert(member.key());
  return names;
}

Names membersOf(const Technique& technique) {
  return {technique.file.members.begin(), technique.file.members.end()};
}

std::vector<float> numbers(std::size_t count) { return std::vector<float>(count, 0.5f); }

/// A bake of a triangle with something of every technique, but for those that Baked adds by the schema.
Bake everything(const Scene& source, const CompiledScene& scene) {
  const std::size_t vertices = scene.vertexCount();
  const HarmonicTransfer harmonics{2, 1, 0, numbers(4 * vertices)};
  Bake bake;
  bake.ao = numbers(vertices);
  bake.bentNormals.assign(vertices, {0, 1, 0});
  bake.apertures = numbers(vertices);
  bake.horizons = HorizonTransfer{4, numbers(4 * vertices), numbers(4 * vertices)};
  bake.sh = bake.ch = harmonics;
  bake.compressedSh = compress(harmonics, parseCompression("half"));
  bake.nearLamps = NearLampTransfer{1, 2, 0.1, 1.0, std::vector<std::uint16_t>(2 * vertices, 0x3800)};
  bake.animation = AnimatedTransfer{0, {0.0}, {harmonics}};
  bake.haar = HaarTransfer{1, 1, 0, {0, 1, 1, 1}, {0}, {1.0f}};
  bake.through = ThroughTransfer{numbers(vertices), harmonics, harmonics, bake.haar};
  bake.glossy = GlossyTransfer{1, 1, 0, numbers(vertices)};
  bake.lightGroups = LightGroupTransfer{{{"lamp", {1, 1, 1}}}, 1, 0, numbers(vertices)};
  bake.occluders = OccluderTransfer{
      {"wall"}, {OccluderVector::Occlusion}, {0, 1, 1, 1}, {0}, {glm::vec4(0, 0.5f, 0, 0.5f)}};
  bake.chartTransfer = ChartTransfer{1, 1, 0, {{0, 1, 1, {{0, 0}, {1, 0}, {0, 1}}, {0.5f}}}};
  bake.irradiance.emplace(vertices, glm::vec3(1.0f));
  bake.volume = VolumeTransfer{
      {{1, 1, 1}, {0, 0, 0}, {1, 1, 1}}, 1, 3, 1, numbers(3), numbers(1), {1}, 1, numbers(3), 1, numbers(3)};
  bake.lightMap.emplace();
  bake.lightMap->layout = makeLightMapLayout(source, scene, {.texels = 64});
  bake.lightMap->values = numbers(3 * bake.lightMap->layout.texelCount());
  const Encoding& encoding = encodings().front();
  bake.encodedLight = {{std::string(encoding.name), numbers(vertices * encoding.values)}};
  return bake;
}

/// A triangle with everything baked, and its picture beside it.
struct Baked {
  test::TemporaryFolder folder;
  GltfDocument document = test::triangleDocument();
  CompiledScene scene;
  Bake bake;

  Baked() {
    document.path = folder / "triangle.glb";
    document.json["materials"] = Json::array(
        {{{"pbrMetallicRoughness", {{"metallicFactor", 0.0}}},
          {"extensions", {{"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 0.5}}}}}}});
    document.json["meshes"][0]["primitives"][0]["material"] = 0;
    document.json["animations"] = Json::array({Json::object()});
    Warnings warnings;
    const Scene source = loadScene(document, warnings);
    scene = compileScene(source, warnings);
    bake = everything(source, scene);
    embed(document, bake);
    for (const Technique& technique : techniques()) addPlainMembers(technique);
    embed(document, bake);
  }

  /// Reads numbers of vertices, which the schema describes as "SCALAR float" or "VEC3 float", as the members
  /// that everything() lacks.
  void addPlainMembers(const Technique& technique) {
    Json& entry = document.json["nodes"][0]["extensions"][transferExtensionName]["primitives"][0];
    const Json schema = schemaOf("primitive");
    for (const std::string_view member : technique.file.members) {
      const std::string name(member), type = schema.value(name, Json::object()).value("description", "");
      if (entry.contains(name)) continue;
      ASSERT_TRUE(type.starts_with("SCALAR float") || type.starts_with("VEC3 float")) << name;
      const std::size_t width = type.starts_with("VEC3") ? 3 : 1;
      entry[name] = appendVertices(document, numbers(width * scene.vertexCount()),
                                   groupRanges(scene).begin()->second, width);
      takeBake(bake, readBy(technique));
    }
  }

  void embed(GltfDocument& into, const Bake& what) const {
    embedBake(into, scene, what);
    if (!what.lightMap) return;
    const std::filesystem::path picture = lightMapPath(into.path);
    embedLightMap(into, scene, what.lightMap->layout, picture.filename().string());
    writeLightMap(picture, *what.lightMap);
  }

  static const Json& rootOf(const GltfDocument& from) {
    return from.json["extensions"][transferExtensionName];
  }
  static const Json& entryOf(const GltfDocument& from) {
    return from.json["nodes"][0]["extensions"][transferExtensionName]["primitives"][0];
  }

  /// The bake that a technique's reader makes from the file on its own.
  Bake readBy(const Technique& technique) const {
    const std::string file = document.path.string();
    const JsonCursor root(file, document.json);
    const BakedInput input{document, root, scene, transferExtension(root)};
    Bake read;
    const auto reader = technique.file.makeReader(input);
    const JsonCursor node = root.at("nodes").at(0);
    for (const auto& [key, ranges] : groupRanges(scene))
      reader->read(transferExtension(node)->at("primitives").at(0), ranges, read);
    reader->finish(read);
    return read;
  }
};

TEST(TechniqueMembers, OfTheSchema_BelongToOneTechniqueEach) {
  std::map<std::string, int> owners;
  for (const std::string& member : membersOfSchema("primitive")) owners[member] = 0;
  owners.erase("quantized");  // holds members of other techniques
  ASSERT_GE(owners.size(), 13u);
  for (const Technique& technique : techniques())
    for (const std::string_view member : technique.file.members) ++owners[std::string(member)];
  for (const auto& [member, count] : owners) EXPECT_EQ(count, 1) << member;
  Names known;
  for (const auto& [member, count] : owners) known.insert(member);
  known.insert("quantized");
  EXPECT_EQ(known, membersOfSchema("primitive"));
}

TEST(TechniqueMembers, OfTheSchema_AreAllWritten) {
  const Baked baked;
  Names plain = membersOfSchema("primitive");
  plain.erase("quantized");
  EXPECT_EQ(membersOf(Baked::entryOf(baked.document)), plain);
  const Names schema = membersOfSchema("root");
  for (const std::string& member : membersOf(Baked::rootOf(baked.document)))
    EXPECT_EQ(schema.count(member), 1u) << member;
}

TEST(TechniqueMembers, EachTechnique_WritesItsOwnAlone) {
  Baked baked;
  const BakedOutput output{baked.document, baked.scene, baked.bake, nullptr};
  for (const Technique& technique : techniques()) {
    if (technique.file.writeEntry == nullptr) continue;
    Json entry = Json::object();
    technique.file.writeEntry(output, groupRanges(baked.scene).begin()->second, entry);
    EXPECT_EQ(membersOf(entry), membersOf(technique)) << technique.name;
  }
}

TEST(TechniqueMembers, EachReader_ReadsItsOwnAlone) {
  const Baked baked;
  for (const Technique& technique : techniques()) {
    ASSERT_NE(technique.file.makeReader, nullptr) << technique.name;
    const Bake read = baked.readBy(technique);
    GltfDocument again = test::triangleDocument();
    again.path = baked.folder / "again.glb";
    baked.embed(again, read);
    EXPECT_EQ(membersOf(Baked::entryOf(again)), membersOf(technique)) << technique.name;
    EXPECT_EQ(read.volume.has_value(), technique.name == "volume") << technique.name;
  }
}

TEST(TechniqueMembers, ThatMayBeBytes_AreThoseOfTheSchema) {
  Baked baked;
  const StoredForms forms{.columns = true};
  embedBake(baked.document, baked.scene, baked.bake, &forms);
  const Json& entry = Baked::entryOf(baked.document);
  EXPECT_EQ(membersOf(entry.at("quantized")), membersOfSchema("quantized"));
  for (const std::string& member : membersOfSchema("quantized"))
    EXPECT_FALSE(entry.contains(member)) << member;
}

/// The members of an object, the last one first.
Json reversed(const Json& object) {
  std::vector<std::pair<std::string, Json>> members;
  for (const auto& member : object.items()) members.emplace_back(member.key(), member.value());
  Json turned = Json::object();
  for (auto member = members.rbegin(); member != members.rend(); ++member)
    turned[member->first] = member->second;
  return turned;
}

/// Versions before this one wrote members in other orders.
TEST(TechniqueMembers, InAnotherOrder_AreReadAlike) {
  const Baked baked;
  GltfDocument turned = baked.document;
  Json& root = turned.json["extensions"][transferExtensionName];
  Json& entry = turned.json["nodes"][0]["extensions"][transferExtensionName]["primitives"][0];
  root = reversed(root);
  entry = reversed(entry);
  ASSERT_NE(root.begin().key(), Baked::rootOf(baked.document).begin().key());
  ASSERT_NE(entry.begin().key(), Baked::entryOf(baked.document).begin().key());
  const auto writtenAgain = [&](const GltfDocument& from) {
    GltfDocument again = test::triangleDocument();
    again.path = baked.folder / "again.glb";
    baked.embed(again, readBake(from, baked.scene).value());
    return again;
  };
  const GltfDocument straight = writtenAgain(baked.document), other = writtenAgain(turned);
  EXPECT_EQ(straight.json, other.json);
  EXPECT_EQ(straight.bin, other.bin);
}

/// If a member were missing, baking a baked file again would leave its numbers in the file.
TEST(TechniqueMembers, OfAccessors_AreAllTakenOff) {
  Baked baked;
  const std::size_t own = test::triangleDocument().json["accessors"].size();
  ASSERT_GT(baked.document.json["accessors"].size(), own + 15);
  embedBake(baked.document, baked.scene, Bake{});
  EXPECT_EQ(baked.document.json["accessors"].size(), own);
}

}  // namespace
}  // namespace prelight
