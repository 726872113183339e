#include <gmock/gmock.h>

#include <map>
#include <set>
#include <string>
#include <tuple>

#include "export/made_up_bake.h"

namespace prelight {
namespace {

using ::testing::IsEmpty;
using Json = nlohmann::ordered_json;
using test::Baked;
using test::bakedOf;
using test::exported;

/// Marks every glTF object with a name, extras and an unknown extension.
void markAll(Json& json, const std::string& path) {
  if (json.is_object()) {
    json["name"] = "name of " + path;
    json["extras"] = {{"mark", "extras of " + path}};
    json["extensions"]["ACME_invented"] = {{"mark", "extension of " + path}};
  }
  for (const char* list : {"scenes", "nodes", "meshes", "primitives", "materials", "textures", "images",
                           "samplers", "cameras", "skins", "animations", "channels", "accessors"})
    if (json.contains(list) && json[list].is_array())
      for (std::size_t i = 0; i < json[list].size(); ++i)
        markAll(json[list][i], path + "/" + list + "/" + std::to_string(i));
}

Json pointerChannel(int sampler, const std::string& pointer) {
  return {
      {"sampler", sampler},
      {"target", {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}};
}

/// A document with a skinned triangle that is lit on both sides; a triangle with morph targets and variants
/// that two nodes and instances draw; a lamp, a camera, animations of all of them, and packets of metadata.
GltfDocument richDocument() {
  GltfDocument document = test::triangleDocument();
  Json& json = document.json;
  json["materials"][0] = {{"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                          {"doubleSided", true},
                          {"occlusionTexture", {{"index", 0}, {"strength", 0.5}}}};
  json["materials"].push_back({{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.25}}}});
  json["images"] =
      Json::array({{{"uri",
                     "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4n"
                     "GP4////fwAJ+wP9CNHoHgAAAABJRU5ErkJggg=="}}});
  json["samplers"] = Json::array({Json::object()});
  json["textures"] = Json::array({{{"source", 0}, {"sampler", 0}}});
  json["extensions"]["KHR_materials_variants"]["variants"] = Json::array({{{"name", "a"}}, {{"name", "b"}}});
  json["extensions"]["KHR_xmp_json_ld"]["packets"] = Json::array({{{"dc:title", "a triangle"}}});
  json["asset"]["extensions"]["KHR_xmp_json_ld"]["packet"] = 0;
  json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::array({{{"type", "point"}, {"extras", "own text"}}});
  json["cameras"] = Json::array(
      {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}, {"zfar", 9.0}}}}});

  Json morphed = json["meshes"][0];
  Json& primitive = morphed["primitives"][0];
  primitive["targets"] =
      Json::array({{{"POSITION", test::appendFloats(document, {0, 0, 1, 0, 0, 0, 0, 0, 0}, "VEC3")}}});
  primitive["material"] = 1;
  primitive["extensions"]["KHR_materials_variants"]["mappings"] =
      Json::array({{{"material", 0}, {"variants", {0}}}, {{"material", 1}, {"variants", {1}}}});
  morphed["weights"] = {0.0};
  json["meshes"].push_back(morphed);

  Json& skinned = json["meshes"][0]["primitives"][0]["attributes"];
  skinned["JOINTS_0"] = test::appendBytes(document, std::vector<std::uint8_t>(12, 0), "VEC4", 3, 5121);
  skinned["WEIGHTS_0"] = test::appendFloats(document, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  json["skins"] = Json::array({{{"joints", {1}}}});
  json["nodes"][0]["skin"] = 0;
  const int places = test::appendFloats(document, {0, 0, 0, 0, 3, 0}, "VEC3");
  json["nodes"].push_back(Json::object());
  json["nodes"].push_back(
      {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {0, 0, 2}}});
  json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 5}}});
  json["nodes"].push_back({{"mesh", 1}, {"translation", {3, 0, 0}}});
  json["nodes"].push_back({{"mesh", 1}, {"translation", {6, 0, 0}}});
  json["nodes"].push_back(
      {{"mesh", 1},
       {"translation", {9, 0, 0}},
       {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
  json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5, 6};

  const int times = test::appendFloats(document, {0, 1}, "SCALAR");
  const int values = test::appendFloats(document, {0, 0}, "SCALAR");
  const int colors = test::appendFloats(document, {1, 1, 1, 1, 0, 0, 0, 1}, "VEC4");
  const Json scalar = {{"input", times}, {"output", values}}, color = {{"input", times}, {"output", colors}};
  json["animations"] =
      Json::array({{{"samplers", {scalar, color}},
                    {"channels",
                     {{{"sampler", 0}, {"target", {{"node", 6}, {"path", "weights"}}}},
                      {{"sampler", 1}, {"target", {{"node", 1}, {"path", "rotation"}}}},
                      pointerChannel(1, "/materials/0/pbrMetallicRoughness/baseColorFactor"),
                      pointerChannel(0, "/meshes/1/weights/0"),
                      pointerChannel(0, "/cameras/0/perspective/yfov")}}},
                   {{"samplers", {scalar}},
                    {"channels",
                     {pointerChannel(0, "/extensions/KHR_lights_punctual/lights/0/intensity"),
                      pointerChannel(0, "/materials/0/occlusionTexture/strength")}}}});
  json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_variants", "KHR_animation_pointer",
                            "KHR_xmp_json_ld",     "ACME_invented",          "EXT_mesh_gpu_instancing"};
  markAll(json, "");
  json["extensions"]["KHR_lights_punctual"]["lights"][0]["name"] = "lamp";
  return document;
}

Baked baked() {
  Baked made = bakedOf(richDocument());
  // Every second chart is dark, so that the map has two pictures.
  LightMap& map = *made.bake.lightMap;
  for (const LightMapTexel& texel : map.layout.texels)
    for (std::size_t c = 0; c < 3; ++c)
      map.values[3 * texel.texel + c] = map.layout.chartOf[texel.face] % 2 == 0 ? 100.0f : 1.0f;
  return made;
}

void collect(const Json& json, const std::string& key, std::multiset<std::string>& found) {
  if (!json.is_structured()) return;
  for (const auto& member : json.items()) {
    if (json.is_object() && member.key() == key && member.value().is_string()) found.insert(member.value());
    collect(member.value(), key, found);
  }
}

std::multiset<std::string> stringsOf(const Json& json, const std::string& key) {
  std::multiset<std::string> found;
  collect(json, key, found);
  return found;
}

/// Finds references to list members that do not exist.
class Dangling {
 public:
  explicit Dangling(const Json& root) : root_(root) {}

  std::vector<std::string> find() {
    visit(root_, "", "");
    for (const std::string& pointer : stringsOf(root_, "pointer"))
      if (!root_.contains(Json::json_pointer(pointer.substr(0, pointer.rfind('/')))))
        found_.push_back(pointer);
    return found_;
  }

 private:
  void expect(const char* list, const Json& index, const std::string& path) {
    if (!root_.contains(list) || index.get<std::size_t>() >= root_[list].size())
      found_.push_back(path + ": " + list + " " + index.dump());
  }

  void visit(const Json& json, const std::string& key, const std::string& path) {
    static const std::map<std::string, const char*> lists = {
        {"mesh", "meshes"},          {"camera", "cameras"},
        {"skin", "skins"},           {"node", "nodes"},
        {"indices", "accessors"},    {"material", "materials"},
        {"source", "images"},        {"input", "accessors"},
        {"output", "accessors"},     {"bufferView", "bufferViews"},
        {"index", "textures"},       {"joints", "nodes"},
        {"children", "nodes"},       {"nodes", "nodes"},
        {"attributes", "accessors"}, {"targets", "accessors"}};
    const auto known = lists.find(key);
    if (json.is_number_integer() && known != lists.end()) expect(known->second, json, path);
    if (!json.is_structured() || key == "extras") return;
    const bool inherits = json.is_array() || key == "attributes";
    for (const auto& member : json.items())
      visit(member.value(), inherits ? (key == "nodes" && path == "/nodes" ? "" : key) : member.key(),
            path + "/" + member.key());
  }

  const Json& root_;
  std::vector<std::string> found_;
};

std::set<std::string> extensionsIn(const Json& json) {
  std::set<std::string> names;
  if (!json.is_structured()) return names;
  for (const auto& member : json.items()) {
    if (json.is_object() && member.key() == "extensions" && member.value().is_object())
      for (const auto& extension : member.value().items()) names.insert(extension.key());
    if (member.key() == "extras") continue;
    names.merge(extensionsIn(member.value()));
  }
  return names;
}

class RoundTrip : public ::testing::TestWithParam<std::tuple<ExportTarget, ExportForm, BakedLights>> {
 protected:
  ExportRequest request() const {
    return {std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam())};
  }
  bool losesLights() const { return holdsLight(request().form) && request().lights == BakedLights::Remove; }
};

TEST_P(RoundTrip, NamesExtrasAndExtensions_AreAllThere) {
  const Baked from = baked();
  const Json after = exported(from, request()).json;
  std::vector<std::string> lost;
  for (const char* key : {"mark", "name", "dc:title"}) {
    const std::multiset<std::string> before = stringsOf(from.document.json, key), now = stringsOf(after, key);
    for (const std::string& value : std::set<std::string>(before.begin(), before.end()))
      if (!now.contains(value)) lost.push_back(value);
  }
  // A removed lamp takes its animation with it, and occlusion that the light map includes is removed.
  const bool noOcclusion = request().form == ExportForm::LightMap;
  std::erase_if(lost, [&](const std::string& value) {
    const bool light = value.ends_with("/animations/1/channels/0") || value == "lamp";
    const bool occlusion = value.ends_with("/animations/1/channels/1");
    const bool both = value.ends_with("/animations/1");
    // Instances become nodes, which hold their places.
    const bool places = value.ends_with("of /accessors/6");
    return (losesLights() && light) || (noOcclusion && occlusion) || (losesLights() && noOcclusion && both) ||
           places;
  });
  EXPECT_THAT(lost, IsEmpty());
}

TEST_P(RoundTrip, Lists_KeepTheirPlaces) {
  const Baked from = baked();
  const Json after = exported(from, request()).json;
  for (const char* list :
       {"scenes", "nodes", "meshes", "materials", "textures", "images", "samplers", "cameras", "skins"})
    for (std::size_t i = 0; i < from.document.json[list].size(); ++i)
      EXPECT_EQ(after[list][i]["extras"]["mark"], from.document.json[list][i]["extras"]["mark"]) << list << i;
  EXPECT_EQ(after["asset"], from.document.json["asset"]);
}

TEST_P(RoundTrip, References_LeadSomewhere) {
  const Json after = exported(baked(), request()).json;
  EXPECT_THAT(Dangling(after).find(), IsEmpty());
  const std::set<std::string> there = extensionsIn(after),
                              said = after["extensionsUsed"].get<std::set<std::string>>();
  for (const std::string& name : there)
    EXPECT_TRUE(said.contains(name)) << name << " is not in extensionsUsed";
  EXPECT_FALSE(said.contains("EXT_mesh_gpu_instancing") != there.contains("EXT_mesh_gpu_instancing"));
}

INSTANTIATE_TEST_SUITE_P(
    Exports, RoundTrip,
    ::testing::Values(std::tuple(ExportTarget::Gltf, ExportForm::LightMap, BakedLights::Remove),
                      std::tuple(ExportTarget::Three, ExportForm::LightMap, BakedLights::Mark),
                      std::tuple(ExportTarget::Raw, ExportForm::LightMap, BakedLights::Keep),
                      std::tuple(ExportTarget::Blender, ExportForm::LightMap, BakedLights::Remove),
                      std::tuple(ExportTarget::Godot, ExportForm::LightMap, BakedLights::Remove),
                      std::tuple(ExportTarget::Unity, ExportForm::LightMap, BakedLights::Remove),
                      std::tuple(ExportTarget::Gltf, ExportForm::Occlusion, BakedLights::Remove),
                      std::tuple(ExportTarget::Gltf, ExportForm::VertexLight, BakedLights::Remove),
                      std::tuple(ExportTarget::Gltf, ExportForm::VertexOcclusion, BakedLights::Remove)));

/// Targets of an animation's channels, as JSON pointers.
std::multiset<std::string> pointersOf(const Json& json) {
  std::multiset<std::string> found = stringsOf(json, "pointer");
  for (const Json& animation : json["animations"])
    for (const Json& channel : animation["channels"])
      if (channel["target"].contains("node"))
        found.insert("/nodes/" + channel["target"]["node"].dump() + "/" +
                     channel["target"]["path"].get<std::string>());
  return found;
}

TEST(RoundTripOfAnimations, WhatTheExportHasMoreThanOnce_MovesAlike) {
  const Json after = exported(baked(), {}).json;
  const std::multiset<std::string> pointers = pointersOf(after);
  // Every material made from the first one, and every mesh made from the second.
  const auto expectAll = [&](const char* list, const char* mark, const std::string& rest) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < after[list].size(); ++i) {
      if (after[list][i].value("/extras/mark"_json_pointer, "") != mark) continue;
      EXPECT_EQ(pointers.count("/" + std::string(list) + "/" + std::to_string(i) + rest), 1u) << list << i;
      ++count;
    }
    EXPECT_GT(count, 1u) << list;
  };
  expectAll("materials", "extras of /materials/0", "/pbrMetallicRoughness/baseColorFactor");
  expectAll("meshes", "extras of /meshes/1", "/weights/0");
  // Instances became nodes 7 and 8, and node 6 draws nothing.
  EXPECT_EQ(pointers.count("/nodes/6/weights"), 0u);
  EXPECT_EQ(pointers.count("/nodes/7/weights"), 1u);
  EXPECT_EQ(pointers.count("/nodes/8/weights"), 1u);
  EXPECT_EQ(pointers.count("/nodes/1/rotation"), 1u);
}

/// Vertices that were duplicated where charts part have accessors of their own.
TEST(RoundTripOfAccessors, CopiesOfSplitVertices_KeepWhatTheirsSaid) {
  GltfDocument document = richDocument();
  const std::vector<float> folded = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  Json& primitive = document.json["meshes"][0]["primitives"][0];
  primitive["attributes"] = {{"POSITION", test::appendFloats(document, folded, "VEC3")}};
  primitive["indices"] = test::appendBytes(document, {0, 1, 2, 0, 3, 1}, "SCALAR", 6, 5121);
  document.json["nodes"][0].erase("skin");
  const auto position = primitive["attributes"]["POSITION"].get<std::size_t>();
  document.json["accessors"][position]["extras"] = {{"mark", "folded"}};
  const Json after = exported(bakedOf(document), {}).json;
  EXPECT_GT(stringsOf(after, "mark").count("folded"), 0u);
  EXPECT_THAT(Dangling(after).find(), IsEmpty());
}

TEST(DanglingReferences, OfBrokenFiles_AreFound) {
  Json after = exported(baked(), {}).json;
  after["materials"].erase(after["materials"].size() - 1);
  after["textures"].clear();
  EXPECT_GT(Dangling(after).find().size(), 2u);
}

TEST(RoundTripOfLights, ExtrasThatAreNoObject_StayWhereLightsAreMarked) {
  const Json after = exported(baked(), {ExportTarget::Gltf, ExportForm::LightMap, BakedLights::Mark}).json;
  EXPECT_EQ(after["extensions"]["KHR_lights_punctual"]["lights"][0]["extras"], "own text");
}

}  // namespace
}  // namespace prelight
