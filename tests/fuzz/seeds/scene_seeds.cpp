#include <array>

#include "fuzz/seeds/seeds.h"
#include "images/ktx2_files.h"
#include "images/picture_codecs.h"
#include "scene/gltf/gltf_embed.h"
#include "support/bent_bar.h"
#include "support/compressed_files.h"
#include "support/gltf_files.h"

namespace prelight::fuzz {

namespace {

using Json = nlohmann::ordered_json;

/// Every material extension, with a texture wherever there may be one. It is dark: finding the parts of a
/// textured emission takes a hundred times as long as everything else.
constexpr const char* everyMaterial =
    R"({"name": "all", "alphaMode": "MASK", "alphaCutoff": 0.4, "doubleSided": true,
"emissiveFactor": [0, 0, 0], "emissiveTexture": {"index": 0}, "normalTexture": {"index": 0, "scale": 0.5},
"occlusionTexture": {"index": 0, "strength": 0.5},
"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.7, 0.6, 0.9], "metallicFactor": 0.3, "roughnessFactor": 0.4,
  "baseColorTexture": {"index": 0, "texCoord": 1, "extensions": {"KHR_texture_transform": {"offset": [0.1, 0.2], "rotation": 0.3, "scale": [2, 3], "texCoord": 0}}},
  "metallicRoughnessTexture": {"index": 1}},
"extensions": {
  "KHR_materials_emissive_strength": {"emissiveStrength": 4}, "KHR_materials_ior": {"ior": 1.4},
  "KHR_materials_transmission": {"transmissionFactor": 0.5, "transmissionTexture": {"index": 0}},
  "KHR_materials_volume": {"thicknessFactor": 0.1, "thicknessTexture": {"index": 0}, "attenuationDistance": 0.5, "attenuationColor": [0.9, 0.8, 0.7]},
  "KHR_materials_volume_scatter": {"multiscatterColor": [0.2, 0.3, 0.4], "scatterAnisotropy": 0.2},
  "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.25, "diffuseTransmissionTexture": {"index": 0}, "diffuseTransmissionColorFactor": [1, 0.5, 0.5], "diffuseTransmissionColorTexture": {"index": 0}},
  "KHR_materials_specular": {"specularFactor": 0.5, "specularTexture": {"index": 0}, "specularColorFactor": [1, 0.9, 0.8], "specularColorTexture": {"index": 0}},
  "KHR_materials_clearcoat": {"clearcoatFactor": 0.6, "clearcoatTexture": {"index": 0}, "clearcoatRoughnessFactor": 0.1, "clearcoatRoughnessTexture": {"index": 0}, "clearcoatNormalTexture": {"index": 0, "scale": 0.7}},
  "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenColorTexture": {"index": 0}, "sheenRoughnessFactor": 0.5, "sheenRoughnessTexture": {"index": 0}},
  "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 1, "anisotropyTexture": {"index": 0}},
  "KHR_materials_iridescence": {"iridescenceFactor": 0.7, "iridescenceTexture": {"index": 0}, "iridescenceIor": 1.3, "iridescenceThicknessMinimum": 100, "iridescenceThicknessMaximum": 400, "iridescenceThicknessTexture": {"index": 0}},
  "KHR_materials_dispersion": {"dispersion": 0.3}}})";

constexpr const char* olderMaterials = R"([{"extensions": {"KHR_materials_unlit": {}}, "alphaMode": "BLEND"},
{"extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [1, 0.5, 0.2, 1], "diffuseTexture": {"index": 0}, "specularFactor": [0.5, 0.5, 0.5], "glossinessFactor": 0.5, "specularGlossinessTexture": {"index": 0}}}}])";

constexpr const char* everyLight = R"([{"type": "point", "intensity": 3, "range": 5, "color": [1, 0.5, 0.2]},
{"type": "directional", "intensity": 2}, {"type": "spot", "intensity": 4, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.7}}])";

constexpr const char* profile = "IES:LM-63-2019\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 1\n0 90\n0\n8 4\n";

Image chequer(int size) {
  Image image{"", size, size, {}};
  for (int i = 0; i < size * size; ++i) {
    const auto value = static_cast<std::uint8_t>((i + i / size) % 2 == 0 ? 20 : 220);
    image.rgba.insert(image.rgba.end(), {value, 128, static_cast<std::uint8_t>(255 - value), value});
  }
  return image;
}

int addPng(GltfDocument& document, int size) {
  const int view = appendBufferView(document, encodePng(chequer(size), PngChannels::Rgba));
  document.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
  return static_cast<int>(document.json["images"].size()) - 1;
}

/// A triangle with two sets of coordinates, tangents and colours.
GltfDocument texturedTriangle() {
  GltfDocument document = test::triangleDocument();
  auto& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_0"] = test::appendFloats(document, {0, 0, 1, 0, 0, 1}, "VEC2");
  const int second = test::appendBytes(document, {0, 0, 255, 0, 0, 255}, "VEC2", 3, 5121);
  document.json["accessors"][second]["normalized"] = true;
  auto& more = document.json["meshes"][0]["primitives"][0]["attributes"];
  more["TEXCOORD_1"] = second;
  more["TANGENT"] = test::appendFloats(document, {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}, "VEC4");
  more["COLOR_0"] = test::appendFloats(document, {1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
  return document;
}

/// A triangle whose attributes Draco and meshopt both take.
GltfDocument compressible() {
  GltfDocument document = test::triangleDocument();
  const int coords = test::appendFloats(document, {0, 0, 1, 0, 0, 1}, "VEC2");
  document.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = coords;
  return document;
}

GltfDocument withMaterials() {
  GltfDocument document = texturedTriangle();
  addPng(document, 4);
  document.json["samplers"] =
      Json::parse(R"([{"magFilter": 9728, "minFilter": 9987, "wrapS": 33071, "wrapT": 33648}])");
  document.json["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}, {"source": 0}])");
  document.json["materials"] = Json::parse(olderMaterials);
  document.json["materials"].insert(document.json["materials"].begin(), Json::parse(everyMaterial));
  auto& primitive = document.json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  document.json["extensions"]["KHR_materials_variants"]["variants"] =
      Json::parse(R"([{"name": "a"}, {"name": "b"}])");
  primitive["extensions"]["KHR_materials_variants"]["mappings"] =
      Json::parse(R"([{"material": 1, "variants": [0]}, {"material": 2, "variants": [1]}])");
  return document;
}

GltfDocument withEmission() {
  GltfDocument document = texturedTriangle();
  addPng(document, 1);
  document.json["textures"] = Json::parse(R"([{"source": 0}])");
  document.json["materials"][0]["emissiveFactor"] = {1, 0.5, 0.25};
  document.json["materials"][0]["emissiveTexture"]["index"] = 0;
  return document;
}

/// Nodes, sparse accessors, instances, cameras, lights of all kinds, a profile and an animation with all
/// three interpolations.
GltfDocument withNodes() {
  GltfDocument document = test::triangleDocument();
  const int offsets = test::appendFloats(document, {0, 0, 0, 2, 0, 0}, "VEC3");
  auto& json = document.json;
  json["accessors"][0]["sparse"] = {{"count", 1},
                                    {"indices", {{"bufferView", 2}, {"componentType", 5121}}},
                                    {"values", {{"bufferView", 1}}}};
  json["nodes"][0]["children"] = {1, 2, 3, 4, 5};
  json["nodes"][0]["rotation"] = {0, 0.6, 0, 0.8};
  json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = offsets;
  json["nodes"].push_back({{"camera", 0}, {"translation", {1, 2, 3}}});
  json["nodes"].push_back({{"camera", 1}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 2, 2, 1}}});
  for (int i = 0; i < 3; ++i)
    json["nodes"].push_back(
        {{"scale", {2, -2, 2}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  json["nodes"][5]["extensions"]["EXT_lights_ies"] = {
      {"light", 0}, {"multiplier", 2}, {"color", {1, 0.5, 0}}};
  json["cameras"] = Json::parse(
      R"([{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "zfar": 9, "aspectRatio": 1.5}},
          {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 1, "znear": 0, "zfar": 10}}])");
  json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(everyLight);
  const int text = appendBufferView(document, bytesOf(profile));
  document.json["extensions"]["EXT_lights_ies"]["lights"] =
      Json::array({{{"bufferView", text}, {"mimeType", "application/x-ies-lm-63"}}});
  const int times = test::appendFloats(document, {0, 1}, "SCALAR");
  const int places = test::appendFloats(document, {0, 0, 0, 1, 0, 0}, "VEC3");
  const int turns = test::appendFloats(document, {0, 0, 0, 1, 0, 0.6f, 0, 0.8f}, "VEC4");
  const int curve = test::appendFloats(document, std::vector<float>(18, 0.5f), "VEC3");
  document.json["animations"] =
      Json::array({{{"name", "all"},
                    {"samplers",
                     {{{"input", times}, {"output", places}},
                      {{"input", times}, {"output", turns}, {"interpolation", "STEP"}},
                      {{"input", times}, {"output", curve}, {"interpolation", "CUBICSPLINE"}}}},
                    {"channels",
                     {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
                      {{"sampler", 1}, {"target", {{"node", 0}, {"path", "rotation"}}}},
                      {{"sampler", 2}, {"target", {{"node", 3}, {"path", "scale"}}}}}}}});
  return document;
}

/// A skin, morph targets, animated weights and an animated material.
GltfDocument withDeformations() {
  GltfDocument document = test::bentBar();
  const std::vector<float> lifts(3 * test::barPositions().size(), 0.25f);
  for (int i = 0; i < 2; ++i) {
    const int position = test::appendFloats(document, lifts, "VEC3"),
              normal = test::appendFloats(document, lifts, "VEC3");
    document.json["meshes"][0]["primitives"][0]["targets"].push_back(
        {{"POSITION", position}, {"NORMAL", normal}});
  }
  document.json["nodes"][2]["weights"] = {0.5, 0.25};
  const int weights = test::appendFloats(document, {0, 0, 1, 2}, "SCALAR");
  const int colors = test::appendFloats(document, {0, 0, 0, 1, 1, 1, 1, 1}, "VEC4");
  auto& animation = document.json["animations"][0];
  const Json times = animation["samplers"][0]["input"];
  animation["samplers"].push_back({{"input", times}, {"output", weights}});
  animation["samplers"].push_back({{"input", times}, {"output", colors}});
  animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", 2}, {"path", "weights"}}}});
  animation["channels"].push_back(
      {{"sampler", 2},
       {"target",
        {{"path", "pointer"},
         {"extensions",
          {{"KHR_animation_pointer",
            {{"pointer", "/materials/0/pbrMetallicRoughness/baseColorFactor"}}}}}}}});
  return document;
}

GltfDocument withSky() {
  GltfDocument document = test::triangleDocument();
  Json faces = Json::array();
  for (int face = 0; face < 6; ++face) faces.push_back(addPng(document, 2));
  document.json["extensions"]["EXT_lights_image_based"]["lights"] =
      Json::array({{{"specularImages", Json::array({faces})},
                    {"specularImageSize", 2},
                    {"intensity", 2},
                    {"rotation", {0, 0, 0, 1}},
                    {"irradianceCoefficients", Json(9, Json::array({0.1, 0.2, 0.3}))}}});
  document.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
  return document;
}

/// Quantised positions, normals and coordinates, a strip and a fan.
GltfDocument quantised() {
  GltfDocument document = test::triangleDocument();
  const int positions =
      test::appendBytes(document, {0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0}, "VEC3", 3, 5120);
  const int normals =
      test::appendBytes(document, {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, "VEC3", 3, 5120);
  for (const int accessor : {positions, normals}) {
    const auto view = document.json["accessors"][accessor]["bufferView"].get<std::size_t>();
    document.json["bufferViews"][view]["byteStride"] = 4;
  }
  document.json["accessors"][normals]["normalized"] = true;
  auto& primitives = document.json["meshes"][0]["primitives"];
  primitives[0]["attributes"] = {{"POSITION", positions}, {"NORMAL", normals}};
  for (const int mode : {5, 6}) {
    Json other = primitives[0];
    other["mode"] = mode;
    primitives.push_back(other);
  }
  document.json["extensionsUsed"] = document.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  return document;
}

/// A KTX2 texture of one block, with a PNG as a fallback, and one in WebP's extension that is no WebP.
GltfDocument withKtx2() {
  GltfDocument document = texturedTriangle();
  test::Ktx2Parts parts;
  parts.level = test::BitWriter().add(0x17, 5).add(200, 8).add(100, 8).add(50, 8).add(25, 8).bytes();
  parts.level.resize(16);
  addPng(document, 1);
  const int view = appendBufferView(document, test::ktx2File(parts));
  document.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/ktx2"}});
  document.json["textures"] = Json::parse(
      R"([{"source": 0, "extensions": {"KHR_texture_basisu": {"source": 1}}}, {"source": 0, "extensions": {"EXT_texture_webp": {"source": 0}}}, {"source": 0, "extensions": {"EXT_texture_avif": {"source": 0}}}])");
  auto& material = document.json["materials"][0];
  for (int i = 0; i < 3; ++i)
    material[std::array{"normalTexture", "emissiveTexture", "occlusionTexture"}[static_cast<std::size_t>(i)]]
            ["index"] = i;
  return document;
}

/// JSON alone, with its buffer in a data URI and an image that is not there.
Seed plainText() {
  return bytesOf(
      R"({"asset": {"version": "2.0", "minVersion": "2.0"}, "scene": 0, "scenes": [{"nodes": [0], "name": "s"}, {"nodes": []}],
"nodes": [{"mesh": 0, "name": "n"}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
"materials": [{"emissiveTexture": {"index": 0}}], "textures": [{"source": 0}], "images": [{"uri": "no%20image.png"}, {"uri": "data:image/png;base64,iVBORw0KGgo="}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
}

}  // namespace

void addSceneSeeds(Seeds& seeds) {
  const GltfDocument materials = withMaterials(), nodes = withNodes();
  seeds["gltf/materials.glb"] = glbOf(materials);
  seeds["gltf/emission.glb"] = glbOf(withEmission());
  seeds["gltf/nodes.glb"] = glbOf(nodes);
  seeds["gltf/deformations.glb"] = glbOf(withDeformations());
  seeds["gltf/sky.glb"] = glbOf(withSky());
  seeds["gltf/quantised.glb"] = glbOf(quantised());
  seeds["gltf/ktx2.glb"] = glbOf(withKtx2());
  seeds["gltf/draco.glb"] = glbOf(test::withDraco(compressible(), {true, 11, 8}));
  seeds["gltf/draco_sequential.glb"] = glbOf(test::withDraco(compressible(), {false, 0, 0}));
  seeds["gltf/meshopt_ext.glb"] = glbOf(test::withMeshopt(compressible()));
  seeds["gltf/meshopt_khr.glb"] =
      glbOf(test::withMeshopt(compressible(), "KHR_meshopt_compression", "INDICES"));
  seeds["gltf/text.gltf"] = plainText();
}

GltfDocument roomToBake() {
  GltfDocument document = test::triangleDocument();
  auto& json = document.json;
  json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::parse(R"([{"type": "point", "intensity": 3, "name": "Lamp"}])");
  json["extensionsUsed"] = {"KHR_lights_punctual"};
  json["materials"][0]["doubleSided"] = true;
  json["materials"][0]["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", 0.5}};
  json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
      test::appendFloats(document, {0, 0, 1, 0, 0, 1}, "VEC2");
  const int times = test::appendFloats(document, {0, 1}, "SCALAR");
  const int places = test::appendFloats(document, {0, 0, 0.5f, 0, 0, 1}, "VEC3");
  auto& tree = document.json;
  tree["nodes"][0]["name"] = "floor";
  tree["nodes"].push_back(
      {{"mesh", 0}, {"name", "roof"}, {"translation", {0, 0, 0.5}}, {"scale", {0.5, 0.5, 0.5}}});
  tree["nodes"].push_back(
      {{"translation", {0.3, 0.3, 1}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  tree["scenes"][0]["nodes"] = {0, 1, 2};
  tree["animations"] =
      Json::array({{{"samplers", {{{"input", times}, {"output", places}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}});
  return document;
}

}  // namespace prelight::fuzz
