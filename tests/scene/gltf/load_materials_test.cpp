#include <gtest/gtest.h>

#include <cmath>

#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

Material loadMaterial(const char* json, Warnings& warnings) {
  GltfDocument document = test::triangleDocument();
  document.json["materials"][0] = Json::parse(json);
  document.json["images"] = Json::parse(R"([{"bufferView": 0}, {"bufferView": 0}])");
  document.json["samplers"] = Json::parse(R"([{"wrapS": 33071, "wrapT": 33648}])");
  document.json["textures"] = Json::parse(R"([{"source": 1, "sampler": 0}, {}])");
  return test::reload(document, warnings).materials.at(0);
}

TEST(LoadMaterial, NothingGiven_IsGltfsDefault) {
  Warnings warnings;
  const Material material = loadMaterial("{}", warnings);
  EXPECT_EQ(material.baseColor, glm::vec4(1.0f));
  EXPECT_EQ(material.metallic, 1.0f);
  EXPECT_EQ(material.roughness, 1.0f);
  EXPECT_EQ(material.ior, 1.5f);
  EXPECT_TRUE(std::isinf(material.attenuationDistance));
  EXPECT_FALSE(material.isEmissive());
  EXPECT_TRUE(warnings.empty());
}

TEST(LoadMaterial, Extensions_AreReadFromIntegersAndFloats) {
  Warnings warnings;
  const Material material = loadMaterial(R"({"emissiveFactor": [1, 0.5, 0], "extensions": {
    "KHR_materials_emissive_strength": {"emissiveStrength": 3000000000},
    "KHR_materials_transmission": {"transmissionFactor": 1},
    "KHR_materials_volume": {"thicknessFactor": 2, "attenuationDistance": 0.5, "attenuationColor": [1, 0, 0]},
    "KHR_materials_ior": {"ior": 0}, "KHR_materials_specular": {"specularFactor": 0, "specularColorFactor": [2, 1, 1]},
    "KHR_materials_unlit": {}}})",
                                         warnings);
  EXPECT_EQ(material.emission, glm::vec3(3e9f, 1.5e9f, 0.0f));
  EXPECT_EQ(material.transmission, 1.0f);
  EXPECT_EQ(material.thickness, 2.0f);
  EXPECT_EQ(material.attenuationDistance, 0.5f);
  EXPECT_EQ(material.attenuationColor, glm::vec3(1, 0, 0));
  EXPECT_EQ(material.ior, 0.0f);
  EXPECT_EQ(material.specular, 0.0f);
  EXPECT_EQ(material.specularColor, glm::vec3(2, 1, 1));
  EXPECT_TRUE(material.unlit);
  EXPECT_TRUE(warnings.empty());
}

TEST(LoadMaterial, DiffuseTransmission_IsReadAndTakenFromTheAlbedo) {
  Warnings warnings;
  const Material material =
      loadMaterial(R"({"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.4, 0.2, 1], "metallicFactor": 0},
    "extensions": {"KHR_materials_diffuse_transmission":
      {"diffuseTransmissionFactor": 0.25, "diffuseTransmissionColorFactor": [1, 0.5, 0]}}})",
                   warnings);
  EXPECT_EQ(material.diffuseTransmission, 0.25f);
  EXPECT_EQ(material.diffuseTransmissionColor, glm::vec3(1.0f, 0.5f, 0.0f));
  EXPECT_EQ(material.diffuseAlbedo(), 0.75f * glm::vec3(0.8f, 0.4f, 0.2f));
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(loadMaterial("{}", warnings).diffuseTransmission, 0.0f);
}

TEST(LoadMaterial, VolumeScatter_IsRead) {
  Warnings warnings;
  Material material = loadMaterial(R"({"extensions": {"KHR_materials_volume_scatter":
    {"multiscatterColor": [0.75, 0.5, 0.25], "scatterAnisotropy": -0.5}}})",
                                   warnings);
  EXPECT_EQ(material.multiscatterColor, glm::vec3(0.75f, 0.5f, 0.25f));
  EXPECT_EQ(material.scatterAnisotropy, -0.5f);
  EXPECT_TRUE(warnings.empty());
  material = loadMaterial(R"({"extensions": {"KHR_materials_volume_scatter": {"scatterAnisotropy": -2}}})",
                          warnings);
  EXPECT_EQ(material.scatterAnisotropy, -1.0f);
  EXPECT_EQ(material.multiscatterColor, glm::vec3(0.0f));
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(LoadMaterial, ValuesOutsideTheirRange_ClampWithWarnings) {
  Warnings warnings;
  const Material material = loadMaterial(R"({"pbrMetallicRoughness":
    {"baseColorFactor": [1.5, -1, 0.5, 1], "metallicFactor": 2, "roughnessFactor": -3},
    "extensions": {"KHR_materials_ior": {"ior": 0.5}, "KHR_materials_volume": {"attenuationDistance": 0}}})",
                                         warnings);
  EXPECT_EQ(material.baseColor, glm::vec4(1.0f, 0.0f, 0.5f, 1.0f));
  EXPECT_EQ(material.metallic, 1.0f);
  EXPECT_EQ(material.roughness, 0.0f);
  EXPECT_EQ(material.ior, 1.0f);
  EXPECT_TRUE(std::isinf(material.attenuationDistance));
  EXPECT_EQ(warnings.size(), 6u);
}

TEST(LoadMaterial, EmissionBeyondMeasure_Throws) {
  Warnings warnings;
  const std::string message = test::inputErrorOf([&] {
    loadMaterial(R"({"emissiveFactor": [10, 10, 10], "extensions": {
      "KHR_materials_emissive_strength": {"emissiveStrength": 1e15}}})",
                 warnings);
  });
  EXPECT_NE(message.find("KHR_materials_emissive_strength"), std::string::npos) << message;
}

TEST(LoadMaterial, EmissiveFactorAboveOne_IsKeptWithAWarning) {
  Warnings warnings;
  EXPECT_EQ(loadMaterial(R"({"emissiveFactor": [10, 10, 10]})", warnings).emission, glm::vec3(10.0f));
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(LoadMaterial, SpecularGlossiness_BecomesADielectric) {
  Warnings warnings;
  const Material material = loadMaterial(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness": {
    "diffuseFactor": [0.5, 0.25, 1, 0.75], "glossinessFactor": 0.25, "specularFactor": [0.04, 0.04, 0.08],
    "diffuseTexture": {"index": 0}}}})",
                                         warnings);
  EXPECT_EQ(material.diffuseAlbedo(), glm::vec3(0.5f, 0.25f, 1.0f));
  EXPECT_EQ(material.baseColor.a, 0.75f);
  EXPECT_EQ(material.metallic, 0.0f);
  EXPECT_EQ(material.roughness, 0.75f);
  EXPECT_NEAR(material.specularColor.b, 2.0f, 1e-6f);
  EXPECT_EQ(material.baseColorTexture.image, 1);
}

TEST(LoadMaterial, AnisotropyIridescenceAndDispersion_AreRead) {
  Warnings warnings;
  const Material material = loadMaterial(R"({"extensions": {
    "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": -1.25, "anisotropyTexture": {"index": 0}},
    "KHR_materials_iridescence": {"iridescenceFactor": 0.75, "iridescenceIor": 1.6, "iridescenceThicknessMinimum": 50,
      "iridescenceThicknessMaximum": 800, "iridescenceTexture": {"index": 0, "texCoord": 1},
      "iridescenceThicknessTexture": {"index": 0}},
    "KHR_materials_dispersion": {"dispersion": 2.5},
    "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatNormalTexture": {"index": 0, "scale": 0.5}}}})",
                                         warnings);
  EXPECT_EQ(material.anisotropy.strength, 0.5f);
  EXPECT_EQ(material.anisotropy.rotation, -1.25f);
  EXPECT_EQ(material.iridescence.factor, 0.75f);
  EXPECT_EQ(material.iridescence.ior, 1.6f);
  EXPECT_EQ(material.iridescence.thicknessMinimum, 50.0f);
  EXPECT_EQ(material.iridescence.thicknessMaximum, 800.0f);
  EXPECT_EQ(material.iridescence.texture.texCoord, 1);
  EXPECT_EQ(material.iridescence.thicknessTexture.image, 1);
  EXPECT_EQ(material.dispersion, 2.5f);
  // An unreadable picture is white, which is no direction.
  EXPECT_EQ(material.anisotropy.texture.image, -1);
  EXPECT_EQ(material.clearcoat.normalTexture.image, -1);
  EXPECT_EQ(material.clearcoat.normalScale, 0.5f);
}

TEST(LoadMaterial, AnisotropyIridescenceAndDispersion_OutsideTheirRange_ClampWithWarnings) {
  Warnings warnings;
  const Material material = loadMaterial(R"({"extensions": {
    "KHR_materials_anisotropy": {"anisotropyStrength": 2}, "KHR_materials_iridescence": {"iridescenceIor": 0.5},
    "KHR_materials_dispersion": {"dispersion": -1}}})",
                                         warnings);
  EXPECT_EQ(material.anisotropy.strength, 1.0f);
  EXPECT_EQ(material.iridescence.ior, 1.0f);
  EXPECT_EQ(material.dispersion, 0.0f);
  EXPECT_EQ(warnings.size(), 3u);
}

TEST(LoadMaterial, BrushedGlass_IsNamedInAWarning) {
  Warnings warnings;
  loadMaterial(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.5},
    "KHR_materials_anisotropy": {"anisotropyStrength": 1}, "KHR_materials_iridescence": {"iridescenceFactor": 1}}})",
               warnings);
  EXPECT_EQ(warnings.size(), 1u);  // The film is drawn.
  EXPECT_TRUE(
      test::anyContains(warnings, "/materials/0: the share that is glass is drawn without anisotropy"));
}

TEST(LoadMaterial, TextureTransform_MatchesItsSpecification) {
  Warnings warnings;
  const Material material =
      loadMaterial(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {
    "KHR_texture_transform": {"offset": [0.25, 0.5], "rotation": 1.5707963267948966, "scale": [2, 3],
    "texCoord": 1}}}}})",
                   warnings);
  const TextureRef& ref = material.baseColorTexture;
  EXPECT_EQ(ref.image, 1);
  EXPECT_EQ(ref.texCoord, 1);
  EXPECT_EQ(ref.wrapS, WrapMode::ClampToEdge);
  EXPECT_EQ(ref.wrapT, WrapMode::MirroredRepeat);
  // The extension's GLSL: translation x rotation x scale, with rotation columns (cos, -sin) and (sin, cos).
  const glm::vec3 uv = ref.transform * glm::vec3(1.0f, 1.0f, 1.0f);
  EXPECT_NEAR(uv.x, 0.25f + 3.0f, 1e-6f);
  EXPECT_NEAR(uv.y, 0.5f - 2.0f, 1e-6f);
}

TEST(LoadMaterial, TexturesOfExtensions_AreRead) {
  Warnings warnings;
  const Material material = loadMaterial(R"({"extensions": {
    "KHR_materials_transmission": {"transmissionFactor": 0.5, "transmissionTexture": {"index": 0}},
    "KHR_materials_specular": {"specularFactor": 0.25, "specularTexture": {"index": 0, "texCoord": 1},
      "specularColorTexture": {"index": 0}}}})",
                                         warnings);
  EXPECT_EQ(material.transmission, 0.5f);
  EXPECT_EQ(material.transmissionTexture.image, 1);
  EXPECT_EQ(material.specular, 0.25f);
  EXPECT_EQ(material.specularTexture.image, 1);
  EXPECT_EQ(material.specularTexture.texCoord, 1);
  EXPECT_EQ(material.specularColorTexture.image, 1);
  EXPECT_FALSE(test::anyContains(warnings, "texture is not"));
}

TEST(LoadMaterial, GlossinessOfATexture_BecomesARoughnessOfItsOwn) {
  GltfDocument document = test::triangleDocument();
  document.json["materials"][0] = Json::parse(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness": {
    "glossinessFactor": 0.25, "specularFactor": [0.08, 0.04, 0.04],
    "specularGlossinessTexture": {"index": 0, "texCoord": 1}}}})");
  document.json["images"] = Json::parse(R"([{"bufferView": 0}])");
  document.json["textures"] = Json::parse(R"([{"source": 0}])");
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);  // An unreadable picture is white.
  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.specularColorTexture.image, 0);
  EXPECT_NEAR(material.specularColor.r, 2.0f, 1e-6f);
  EXPECT_EQ(material.metallic, 0.0f);
  EXPECT_EQ(material.roughness, 1.0f);
  EXPECT_EQ(material.metallicRoughnessTexture.image, 1);
  EXPECT_EQ(material.metallicRoughnessTexture.texCoord, 1);
  ASSERT_EQ(scene.images.size(), 2u);
  EXPECT_EQ(scene.images[1].rgba.at(1), 191);  // 1 - 0.25 x 1.
}

TEST(LoadMaterial, SpecularBesideSpecularGlossiness_IsLeftOutAndSaid) {
  GltfDocument document = test::triangleDocument();
  document.json["materials"][0] = Json::parse(R"({"extensions": {
    "KHR_materials_pbrSpecularGlossiness": {"glossinessFactor": 0.25, "specularFactor": [0.08, 0.04, 0.04],
      "specularGlossinessTexture": {"index": 0, "texCoord": 1}},
    "KHR_materials_specular": {"specularFactor": 0.5, "specularColorTexture": {"index": 1}}}})");
  document.json["images"] = Json::parse(R"([{"bufferView": 0}, {"bufferView": 0}])");
  document.json["textures"] = Json::parse(R"([{"source": 0}, {"source": 1}])");
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.specularColorTexture.image, 0);
  EXPECT_EQ(material.specular, 1.0f);
  EXPECT_EQ(material.metallicRoughnessTexture.texCoord, 1);
  ASSERT_EQ(scene.images.size(), 3u);
  EXPECT_EQ(scene.images[2].rgba.at(1), 191);
  EXPECT_TRUE(test::anyContains(warnings, "/materials/0/extensions/KHR_materials_specular: not for"));
}

TEST(LoadMaterial, GlossinessOfOneTextureAndFactor_IsOneImage) {
  GltfDocument document = test::triangleDocument();
  const auto material = [](double factor) {
    Json json = Json::parse(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness": {
      "specularGlossinessTexture": {"index": 0}}}})");
    json["extensions"]["KHR_materials_pbrSpecularGlossiness"]["glossinessFactor"] = factor;
    return json;
  };
  document.json["materials"] = {material(0.25), material(0.25), material(0.75)};
  document.json["images"] = Json::parse(R"([{"bufferView": 0}])");
  document.json["textures"] = Json::parse(R"([{"source": 0}])");
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  EXPECT_EQ(scene.materials.at(0).metallicRoughnessTexture.image, 1);
  EXPECT_EQ(scene.materials.at(1).metallicRoughnessTexture.image, 1);
  EXPECT_EQ(scene.materials.at(2).metallicRoughnessTexture.image, 2);
  EXPECT_EQ(scene.images.size(), 3u);
}

TEST(LoadMaterial, MagnificationFilter_IsRead) {
  Warnings warnings;
  const auto filter = [&](const char* sampler) {
    GltfDocument document = test::triangleDocument();
    document.json["materials"][0] = Json::parse(R"({"emissiveTexture": {"index": 0}})");
    document.json["images"] = Json::parse(R"([{"bufferView": 0}])");
    document.json["samplers"][0] = Json::parse(sampler);
    document.json["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}])");
    return test::reload(document, warnings).materials.at(0).emissiveTexture.filter;
  };
  EXPECT_EQ(filter("{}"), TextureFilter::Linear);
  EXPECT_EQ(filter(R"({"magFilter": 9729})"), TextureFilter::Linear);
  EXPECT_EQ(filter(R"({"magFilter": 9728})"), TextureFilter::Nearest);
}

TEST(LoadMaterial, TextureWithoutImageOrWithThirdSet_IsIgnoredWithAWarning) {
  Warnings warnings;
  const Material material = loadMaterial(
      R"({"emissiveTexture": {"index": 1}, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 2}}})",
      warnings);
  EXPECT_EQ(material.emissiveTexture.image, -1);
  EXPECT_EQ(material.baseColorTexture.image, -1);
  EXPECT_EQ(warnings.size(), 2u);
}

}  // namespace
}  // namespace prelight
