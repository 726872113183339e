#include "viewer/web/web_page.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <regex>
#include <set>

#include "basis/sh.h"
#include "compress/small_floats.h"
#include "export/relight_module.h"
#include "prelight/error.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/compressed_files.h"
#include "support/gltf_files.h"
#include "viewer/open_transfers.h"
#include "viewer/web/page_parts.h"

namespace prelight {
namespace {

using namespace test;
using namespace viewer;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

constexpr int order = 4;

/// A lit quad with transfer in SH.
QuadScene bakedQuad() {
  QuadScene quad = litQuad(true);
  quad.bake.sh = tiltedTransfer(4, order, 3);
  return quad;
}

PageContents contentsOf(const RenderInputs& inputs, const GltfDocument& document,
                        std::vector<PageSky> skies = {}, const std::string& title = "quad") {
  return {inputs, document, title, std::move(skies)};
}

template <typename T>
std::vector<T> arrayOf(const PageScene& page, const std::string& name) {
  const Json& place = page.description["arrays"][name];
  const std::size_t bytes = place["count"].get<std::size_t>() * (place["type"] == "f16" ? 2 : 4);
  std::vector<T> values(bytes / sizeof(T));
  std::memcpy(values.data(), page.data.bytes().data() + place["offset"].get<std::size_t>(), bytes);
  return values;
}

glm::vec3 decoded(std::uint32_t shared) {
  const float step = std::ldexp(1.0f, static_cast<int>(shared >> 27) - 24);
  return step * glm::vec3(shared & 511u, shared >> 9 & 511u, shared >> 18 & 511u);
}

TEST(SharedExponent, Colours_AreWithinHalfAStepOfTheLargestChannel) {
  for (const float scale : {1e-3f, 0.1f, 1.0f, 3.99f, 511.4f, 60000.0f}) {
    const glm::vec3 color = scale * glm::vec3(1.0f, 0.37f, 0.002f);
    const glm::vec3 found = decoded(sharedExponent(color));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], color[c], color.r / 512.0f) << scale << " " << c;
  }
  EXPECT_EQ(sharedExponent({0.0f, -1.0f, 0.0f}), 0u);
  EXPECT_EQ(decoded(sharedExponent(glm::vec3(1e9f))), glm::vec3(65408.0f));  // OpenGL's largest value.
  EXPECT_EQ(decoded(sharedExponent(glm::vec3(1.0f, 0.5f, 0.25f))), glm::vec3(1.0f, 0.5f, 0.25f));
}

/// RFC 4648, section 10.
TEST(Base64, Texts_AreThoseOfTheStandard) {
  const auto encoded = [](std::string_view text) { return toBase64(std::as_bytes(std::span(text))); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xff\xfe\xfd"), "//79");
}

TEST(WebPage, Numbers_AreThoseOfSceneAndBake) {
  QuadScene quad = bakedQuad();
  quad.bake.irradiance = std::vector<glm::vec3>(4, glm::vec3(1.0f, 2.0f, 4.0f));
  const GltfDocument document;
  const PageScene page = pageScene(contentsOf(quad.inputs(), document));
  EXPECT_EQ(arrayOf<glm::vec3>(page, "positions"), quad.compiled.positions);
  EXPECT_EQ(arrayOf<glm::vec3>(page, "normals"), quad.compiled.normals);
  EXPECT_EQ(arrayOf<glm::uvec3>(page, "triangles"), quad.compiled.triangles);
  const std::vector<std::uint16_t> halves = arrayOf<std::uint16_t>(page, "sh");
  ASSERT_EQ(halves.size(), quad.bake.sh->coefficients.size());
  for (std::size_t i = 0; i < halves.size(); ++i)
    EXPECT_NEAR(fromHalf(halves[i]), quad.bake.sh->coefficients[i],
                std::abs(quad.bake.sh->coefficients[i]) / 2048.0f + 1e-7f);
  const std::vector<std::uint16_t> radiance = arrayOf<std::uint16_t>(page, "radiosity");
  EXPECT_NEAR(fromHalf(radiance[2]), 4.0 * std::numbers::inv_pi, 1e-3);
}

TEST(WebPage, Techniques_AreThoseOfTheBakeInTheirOrder) {
  QuadScene quad = bakedQuad();
  quad.bake.ao = std::vector<float>(4, 0.5f);
  quad.bake.bentNormals = std::vector<glm::vec3>(4, glm::vec3(0, 0, 1));
  const GltfDocument document;
  const PageScene page = pageScene(contentsOf(quad.inputs(), document));
  const Json& techniques = page.description["techniques"];
  ASSERT_EQ(techniques.size(), 2u);
  EXPECT_EQ(techniques[0]["name"], "sh");
  EXPECT_EQ(techniques[1]["name"], "ao");
  EXPECT_EQ(page.description["before"]["name"], "phong");
  EXPECT_EQ(page.description["lights"].size(), quad.scene.lights.size());
}

/// Every part of the bake is either shown or left out for a reason.
TEST(WebPage, PartsOfTheBake_AreShownOrLeftOutWithAReason) {
  QuadScene quad = bakedQuad();
  quad.bake.horizons = HorizonTransfer{4, std::vector<float>(16, 0.1f), {}};
  const GltfDocument document;
  const Json report = pageReport(pageScene(contentsOf(quad.inputs(), document)));
  ASSERT_EQ(report["shadings"].size(), 1u);
  EXPECT_EQ(report["shadings"][0]["name"], "sh");
  EXPECT_EQ(report["shadings"][0]["bytes"], 4u * 3u * order * order * 2u);
  ASSERT_EQ(report["leftOut"].size(), 1u);
  EXPECT_EQ(report["leftOut"][0]["what"], "horizons");
  EXPECT_FALSE(report["leftOut"][0]["why"].get<std::string>().empty());
}

/// Rows of the front alternate with rows of the other side, and a single channel is repeated three times.
TEST(WebPage, OtherSides_LieBesideFronts) {
  QuadScene quad = bakedQuad();
  quad.bake.through.emplace();
  quad.bake.through->sh = HarmonicTransfer{2, 1, 0, std::vector<float>(16)};
  for (std::size_t i = 0; i < 16; ++i) quad.bake.through->sh->coefficients[i] = static_cast<float>(i);
  const GltfDocument document;
  const PageScene page = pageScene(contentsOf(quad.inputs(), document));
  const Json& transfer = page.description["techniques"][0]["transfer"];
  EXPECT_EQ(transfer["sides"], 2);
  const std::vector<std::uint16_t> rows = arrayOf<std::uint16_t>(page, "sh");
  constexpr std::size_t length = order * order;
  ASSERT_EQ(rows.size(), 4u * 2u * 3u * length);
  const auto at = [&](std::size_t vertex, std::size_t side, std::size_t channel, std::size_t i) {
    return fromHalf(rows[((vertex * 2 + side) * 3 + channel) * length + i]);
  };
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(at(2, 0, c, 3), quad.bake.sh->coefficients[(2 * 3 + c) * length + 3], 1e-3);
    EXPECT_EQ(at(2, 1, c, 3), 11.0f);
    EXPECT_EQ(at(2, 1, c, 4), 0.0f);  // The other side's transfer has two bands.
  }
}

TEST(WebPage, NearLamps_AreOnceForShAndCh) {
  QuadScene quad = bakedQuad();
  quad.bake.ch = tiltedTransfer(4, 2, 1);
  quad.bake.nearLamps = NearLampTransfer{2, 3, 0.1, 10.0, std::vector<std::uint16_t>(4 * 3 * 4)};
  for (std::size_t i = 0; i < quad.bake.nearLamps->halves.size(); ++i)
    quad.bake.nearLamps->halves[i] = static_cast<std::uint16_t>(i);
  const GltfDocument document;
  const PageScene page = pageScene(contentsOf(quad.inputs(), document));
  EXPECT_EQ(arrayOf<std::uint16_t>(page, "nearLamps"), quad.bake.nearLamps->halves);
  for (const Json& technique : page.description["techniques"]) {
    const Json& near = technique["transfer"]["nearLamps"];
    EXPECT_EQ(near["shells"], 3);
  }
  EXPECT_LT(page.description["techniques"][1]["bytes"], page.description["techniques"][0]["bytes"]);
}

/// M_00 and another entry, multiplied by sqrt(4 pi), [vertex][i][channel][j].
TEST(WebPage, GlossyMatrices_AreRowsOfASeries) {
  QuadScene quad = litQuad(false);
  quad.bake.glossy = GlossyTransfer{2, 3, 1, std::vector<float>(4 * 3 * 16, 0.0f)};
  quad.bake.glossy->matrices[((1 * 3 + 2) * 4 + 0) * 4 + 0] = 0.05f;
  quad.bake.glossy->matrices[((1 * 3 + 2) * 4 + 3) * 4 + 1] = -0.5f;
  const GltfDocument document;
  const PageScene page = pageScene(contentsOf(quad.inputs(), document));
  const std::vector<std::uint16_t> rows = arrayOf<std::uint16_t>(page, "glossy");
  const double scale = std::sqrt(4.0 * std::numbers::pi);
  EXPECT_NEAR(fromHalf(rows[((1 * 4 + 0) * 3 + 2) * 4 + 0]), scale * 0.05, 1e-3);
  EXPECT_NEAR(fromHalf(rows[((1 * 4 + 3) * 3 + 2) * 4 + 1]), scale * -0.5, 1e-3);
  EXPECT_NEAR(fromHalf(arrayOf<std::uint16_t>(page, "glossyOpen")[1]), 4.0 * std::numbers::pi * 0.05 / 3.0,
              1e-3);
}

/// Reading a scene decodes its meshes; pages contain bytes of the file for images only.
TEST(WebPage, CompressedMeshes_AreThereDecoded) {
  const GltfDocument plain = makeBuiltinScene("cornell");
  const auto positionsOf = [](const GltfDocument& document) {
    Warnings warnings;
    const Scene scene = test::reload(document, warnings);
    const CompiledScene compiled = compileScene(scene, warnings);
    Bake bake;
    bake.ao.assign(compiled.vertexCount(), 1.0f);
    bake.bentNormals = compiled.normals;
    const RenderInputs inputs{scene, compiled, &bake};
    return arrayOf<glm::vec3>(pageScene(contentsOf(inputs, document)), "positions");
  };
  const std::vector<glm::vec3> expected = positionsOf(plain);
  EXPECT_EQ(positionsOf(test::withDraco(plain, {false, 0, 0})), expected);
  EXPECT_EQ(positionsOf(test::withMeshopt(plain, "EXT_meshopt_compression", "INDICES")), expected);
}

TEST(WebPage, WideSky_IsAveragedDownAndKeepsItsCoefficients) {
  QuadScene quad = bakedQuad();
  Environment sky{2048, 1024, std::vector<glm::vec3>(2048 * 1024, glm::vec3(2.0f, 1.0f, 0.5f))};
  const GltfDocument document;
  const PageScene page = pageScene(contentsOf(quad.inputs(), document, {{"even", std::move(sky)}}));
  const Json& described = page.description["skies"][0];
  EXPECT_EQ(described["width"], mostSkyWidth);
  EXPECT_EQ(described["name"], "even");
  const std::vector<std::uint32_t> texels = arrayOf<std::uint32_t>(page, "sky0");
  ASSERT_EQ(texels.size(), 512u * 256u);
  EXPECT_EQ(decoded(texels[1234]), glm::vec3(2.0f, 1.0f, 0.5f));
  EXPECT_EQ(described["coefficients"].size(), 16u);
  EXPECT_NEAR(described["coefficients"][0][0].get<double>(), 2.0 * std::sqrt(4.0 * std::numbers::pi), 1e-6);
}

/// Names of scenes and nodes are a stranger's. "<!--" and "<script" would make a browser look for another end
/// of the script that they stand in.
TEST(WebPage, Text_IsWholeByItself) {
  constexpr const char* hostile = "</title><script><!--<script></script>";
  QuadScene quad = bakedQuad();
  const GltfDocument document;
  const std::string page = webPage(pageScene(contentsOf(quad.inputs(), document, {}, hostile)));
  EXPECT_THAT(page, HasSubstr("&lt;/title>"));
  for (const char* part :
       {"http://", "https://", "import ", "fetch(", "XMLHttpRequest", "</title><script>", "<!--", "url("})
    EXPECT_THAT(page, Not(HasSubstr(part)));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr("connect-src")));
  EXPECT_FALSE(std::regex_search(page, std::regex("<[^>]* (src|href)=")));
  const auto within = [&](const std::string& start) {
    const std::size_t from = page.find(start) + start.size();
    return page.substr(from, page.find("</script>", from) - from);
  };
  const PageScene scene = pageScene(contentsOf(quad.inputs(), document, {}, hostile));
  EXPECT_EQ(Json::parse(within("<script type=\"application/json\" id=\"scene\">")), scene.description);
  EXPECT_EQ(within("<script type=\"text/plain\" id=\"data\">"), toBase64(scene.data.bytes()));
}

/// The shaders that a page knows: its own and those of prelight.js.
Json knownShaders(const std::set<std::string>& ambients) {
  Json shaders = pageShaders(ambients);
  for (const auto& [name, text] : relightShaders()) {
    EXPECT_FALSE(shaders.contains(name)) << name << " is in the page twice";
    shaders[name] = text;
  }
  return shaders;
}

/// A missing include would otherwise be noticed by the browser alone.
TEST(WebPage, Shaders_HaveAllThatTheyInclude) {
  const Json shaders = knownShaders({"ambient.glsl", "accessible_ambient.glsl", "transferred_ambient.glsl",
                                     "light_map_ambient.glsl", "cone_ambient.glsl"});
  std::size_t included = 0;
  const std::regex include("#include \"([^\"]+)\"");
  for (const auto& [name, text] : shaders.items()) {
    const std::string source = text.get<std::string>();
    EXPECT_THAT(source, Not(HasSubstr("samplerCubeArray"))) << name;  // WebGL 2 has none.
    for (std::sregex_iterator at(source.begin(), source.end(), include), end; at != end; ++at, ++included)
      EXPECT_TRUE(shaders.contains((*at)[1].str())) << name << " includes " << (*at)[1];
  }
  EXPECT_GT(included, 20u);
}

/// Adds the samplers that a shader and what it includes declare.
void addSamplers(const Json& shaders, const std::string& name, std::set<std::string>& samplers) {
  const std::string source = shaders[name].get<std::string>();
  const std::regex sampler("uniform (?:U?TEXELS|sampler\\w+) (\\w+);"), include("#include \"([^\"]+)\"");
  for (std::sregex_iterator at(source.begin(), source.end(), sampler), end; at != end; ++at)
    samplers.insert((*at)[1].str());
  for (std::sregex_iterator at(source.begin(), source.end(), include), end; at != end; ++at) {
    const std::string path = (*at)[1].str();
    addSamplers(shaders, path == "ambient.glsl" ? "transferred_ambient.glsl" : path, samplers);
  }
}

/// WebGL 2 promises 16 units: glossy pages read no light maps and no caustics.
TEST(WebPage, GlossyShading_LeavesUnitsForFourTexturesOfMaterials) {
  std::set<std::string> samplers;
  addSamplers(knownShaders({"ambient.glsl", "transferred_ambient.glsl"}), "surface.frag", samplers);
  EXPECT_TRUE(samplers.contains("measuredLobes") && samplers.contains("skyLobes"));
  std::erase_if(samplers, [](const std::string& name) {
    return name == "caustics" || name.starts_with("lightMap") || name.ends_with("Texture");
  });
  EXPECT_LE(samplers.size() + 4, 16u) << ::testing::PrintToString(samplers);
}

TEST(WebPage, BakeOfNothingThatItShows_IsAUsageError) {
  QuadScene quad = litQuad(false);
  const GltfDocument document;
  try {
    pageScene(contentsOf(quad.inputs(), document));
    FAIL() << "no error";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("nothing that a page shows"));
  }
}

}  // namespace
}  // namespace prelight
