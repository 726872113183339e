#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "compress/small_floats.h"
#include "io/baked_file.h"
#include "io/baked_strip.h"
#include "io/misfit.h"
#include "library/save.h"
#include "scene/builtin/builtin.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

std::vector<float> between(float least, float most, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> distribution(least, most);
  std::vector<float> numbers(count);
  for (float& number : numbers) number = distribution(random);
  return numbers;
}

std::vector<std::uint16_t> halvesOf(const std::vector<float>& numbers) {
  std::vector<std::uint16_t> halves;
  for (const float number : numbers) halves.push_back(toHalf(number));
  return halves;
}

HaarTransfer sparseWavelets(std::size_t rows) {
  HaarTransfer haar{32, 3, 1, {0}, {}, {}};
  std::mt19937 random(11);
  const auto below = [&](std::uint32_t most) { return static_cast<std::uint32_t>(random() % most); };
  for (std::size_t row = 0; row < rows; ++row) {
    std::uint32_t index = below(100);
    for (std::size_t i = 0; i < row % 5; ++i, index += 1 + below(900)) {
      haar.indices.push_back(index);
      haar.values.push_back(std::ldexp(float(int(below(255)) - 127), -int(below(12))));
    }
    haar.offsets.push_back(static_cast<std::uint32_t>(haar.indices.size()));
  }
  return haar;
}

/// Two nodes that share a triangle, with a column of every kind.
struct QuantizedFile {
  GltfDocument document = test::triangleDocument();
  CompiledScene scene;
  Bake bake;
  StoredForms forms{.columns = true};

  QuantizedFile() {
    document.json["nodes"].push_back({{"name", "other"}, {"mesh", 0}});
    document.json["scenes"][0]["nodes"] = {1, 0};
    scene = test::compileDocument(document);
    const std::size_t n = scene.vertexCount();
    bake.ao = between(0.0f, 1.0f, n, 1);
    for (std::size_t v = 0; v < n; ++v) {
      const std::vector<float> xyz = between(-1.0f, 1.0f, 3, unsigned(v) + 20);
      bake.bentNormals.push_back(glm::normalize(glm::vec3(xyz[0], xyz[1], xyz[2])));
    }
    bake.apertures = between(0.0f, 1.0f, n, 2);
    bake.horizons = HorizonTransfer{5, between(0.0f, 1.5707963f, 5 * n, 3), between(0.0f, 0.5f, 5 * n, 4)};
    bake.ch = HarmonicTransfer{3, 3, 1, between(-1.0f, 1.0f, 27 * n, 5)};
    bake.nearLamps = NearLampTransfer{2, 3, 0.125, 7.5, halvesOf(between(-0.3f, 0.3f, 12 * n, 6))};
    bake.glossy = GlossyTransfer{2, 3, 1, between(-1.0f, 1.0f, 48 * n, 7)};
    bake.haar = sparseWavelets(3 * n);
    bake.lightGroups = LightGroupTransfer{{{"lamp", {1, 1, 1}}}, 3, 1, between(0.0f, 4.0f, 3 * n, 8)};
    bake.thickness = between(0.0f, 0.25f, n, 9);
  }

  Bake readBack() {
    embedBake(document, scene, bake, &forms);
    return readBake(document, scene).value();
  }

  Json& entry(std::size_t node = 0) {
    return document.json["nodes"][node]["extensions"]["PRELIGHT_transfer"]["primitives"][0];
  }
};

void expectNear(const std::vector<float>& read, const std::vector<float>& numbers,
                const std::function<double(std::size_t)>& most) {
  ASSERT_EQ(read.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_NEAR(read[i], numbers[i], most(i) * (1.0 + 1e-5)) << i;
}

/// Returns the greatest magnitude of the group of a number.
double groupScale(const std::vector<float>& numbers, std::size_t i, std::size_t group) {
  double greatest = 0.0;
  for (std::size_t j = i / group * group; j < (i / group + 1) * group; ++j)
    greatest = std::max(greatest, double(std::abs(numbers[j])));
  return greatest;
}

/// Returns half the widest step of squares of 127 levels; a scale is at most 2^-10 above the greatest number.
double squareStep(double greatest) { return greatest * (1.0 + 0x1p-10) / 127.0; }

TEST(BakedQuantized, WriteRead_IsWithinHalfAStep) {
  QuantizedFile file;
  const Bake& full = file.bake;
  const Bake read = file.readBack();
  expectNear(read.ao, full.ao, [](std::size_t) { return 1.0 / 255.0; });
  expectNear(read.apertures, full.apertures, [](std::size_t) { return 0.5 / 255.0; });
  for (const auto& [one, other] : {std::pair(&read.horizons->angles, &full.horizons->angles),
                                   std::pair(&read.horizons->feet, &full.horizons->feet)})
    expectNear(*one, *other, [](std::size_t) { return 1.5707964 * 0.5 / 255.0; });
  expectNear(read.ch->coefficients, full.ch->coefficients,
             [&](std::size_t i) { return squareStep(groupScale(full.ch->coefficients, i, 9)); });
  expectNear(read.glossy->matrices, full.glossy->matrices,
             [&](std::size_t i) { return squareStep(groupScale(full.glossy->matrices, i, 4)); });
  expectNear(read.lightGroups->coefficients, full.lightGroups->coefficients,
             [&](std::size_t i) { return squareStep(groupScale(full.lightGroups->coefficients, i, 3)); });
  expectNear(read.thickness, full.thickness, [](std::size_t) { return 0.25 / 255.0; });
  ASSERT_EQ(read.bentNormals.size(), full.bentNormals.size());
  for (std::size_t v = 0; v < full.bentNormals.size(); ++v) {
    EXPECT_NEAR(glm::length(read.bentNormals[v]), 1.0f, 1e-6f);
    EXPECT_LT(glm::length(read.bentNormals[v] - full.bentNormals[v]), 2.0 * std::sqrt(3.0) * 0.5 / 127.0);
  }
}

TEST(BakedQuantized, NearLamps_AreWithinHalfAStepOfTheirShell) {
  QuantizedFile file;
  std::vector<float> full, read;
  for (const std::uint16_t half : file.bake.nearLamps->halves) full.push_back(fromHalf(half));
  const Bake copy = file.readBack();
  for (const std::uint16_t half : copy.nearLamps->halves) read.push_back(fromHalf(half));
  // A step of bytes, and one of the halves that the reader rounds to.
  expectNear(read, full, [&](std::size_t i) {
    return groupScale(full, i, 4) * (1.0 + 0x1p-10) * (0.5 / 127.0 + 0x1p-11);
  });
}

TEST(BakedQuantized, Wavelets_KeepTheirIndicesAndRows) {
  QuantizedFile file;
  const HaarTransfer& full = *file.bake.haar;
  const HaarTransfer read = *file.readBack().haar;
  EXPECT_EQ(read.offsets, full.offsets);
  EXPECT_EQ(read.indices, full.indices);
  for (std::size_t row = 0; row + 1 < full.offsets.size(); ++row) {
    double greatest = 0.0;
    for (std::uint32_t i = full.offsets[row]; i < full.offsets[row + 1]; ++i)
      greatest = std::max(greatest, double(std::abs(full.values[i])));
    for (std::uint32_t i = full.offsets[row]; i < full.offsets[row + 1]; ++i)
      EXPECT_NEAR(read.values[i], full.values[i], squareStep(greatest));
  }
}

TEST(BakedQuantized, Members_StandApartAndAreTakenOffAgain) {
  QuantizedFile file;
  const Json accessors = file.document.json["accessors"];
  file.readBack();
  for (const char* member : {"ao", "bentNormal", "aperture", "horizons", "ch", "nearLamps", "glossy", "haar",
                             "lightGroups", "thickness"}) {
    EXPECT_FALSE(file.entry().contains(member)) << member;
    EXPECT_TRUE(file.entry()["quantized"].contains(member)) << member;
  }
  const Json bytes = file.document.json["accessors"][file.entry()["quantized"]["ao"]["bytes"].get<int>()];
  EXPECT_EQ(bytes["componentType"], 5121);
  EXPECT_EQ(bytes["normalized"], true);
  embedBake(file.document, file.scene, Bake{});
  EXPECT_EQ(file.document.json["accessors"], accessors);
}

TEST(BakedQuantized, Savings_CountWhatIsInTheFile) {
  QuantizedFile file;
  const SavingsByColumn saved = embedBake(file.document, file.scene, file.bake, &file.forms);
  const std::size_t n = file.scene.vertexCount();
  EXPECT_EQ(saved.at("ao").plainBytes, 4 * n);
  EXPECT_EQ(saved.at("ao").bytes, n);
  EXPECT_EQ(saved.at("bent normals").bytes, 3 * n);
  EXPECT_EQ(saved.at("horizons").bytes, 5 * n);
  EXPECT_EQ(saved.at("near lamps").plainBytes, n * 12 * 2);
  EXPECT_EQ(saved.at("near lamps").bytes, n * (12 + 3 * 2));
  EXPECT_EQ(saved.at("glossy matrices").bytes, n * (48 + 12 * 2));
  const auto countOf = [&](const Json& index) {
    return file.document.json["accessors"][index.get<std::size_t>()]["count"].get<std::size_t>();
  };
  std::size_t wavelets = 0;
  for (std::size_t node = 0; node < 2; ++node) {
    const Json& haar = file.entry(node)["quantized"]["haar"];
    wavelets += countOf(haar["indices"]["gaps"]) + countOf(haar["values"]["bytes"]) +
                2 * countOf(haar["values"]["scales"]);
  }
  EXPECT_EQ(saved.at("Haar").bytes, wavelets);
  EXPECT_EQ(saved.at("Haar").plainBytes, 6 * file.bake.haar->indices.size());
  for (const auto& [name, column] : saved) {
    EXPECT_GT(column.error(), 0.0) << name;
    EXPECT_LT(column.error(), 0.01) << name;
  }
}

TEST(BakedQuantized, PartsOfAPicture_AreThoseOfTheFile) {
  QuantizedFile file;
  Bake shown = file.bake;
  decodeStored(file.document, file.scene, file.forms, shown);
  const Bake read = file.readBack();
  EXPECT_EQ(shown.ao, read.ao);
  EXPECT_EQ(shown.glossy->matrices, read.glossy->matrices);
  EXPECT_EQ(shown.haar->values, read.haar->values);
  EXPECT_EQ(shown.nearLamps->halves, read.nearLamps->halves);
  EXPECT_NE(shown.glossy->matrices, file.bake.glossy->matrices);
}

TEST(BakedQuantized, PartsOfAPictureWithKeys_KeepTheKeysAsTheyAre) {
  QuantizedFile file;
  const NearLampTransfer shells = *file.bake.nearLamps;
  const HarmonicTransfer sh{1, 1, 0, std::vector<float>(file.scene.vertexCount(), 0.25f)};
  file.bake.animation = AnimatedTransfer{0, {0.0, 1.0}, {sh, sh}, {shells, shells}};
  Bake shown = file.bake;
  decodeStored(file.document, file.scene, file.forms, shown);
  ASSERT_TRUE(shown.animation);
  ASSERT_EQ(shown.animation->nearLamps.size(), 2u);
  EXPECT_EQ(shown.animation->nearLamps[1].halves, shells.halves);
  EXPECT_NE(shown.nearLamps->halves, shells.halves);
}

TEST(BakedQuantized, WaveletsOfNothing_AreReadBackEmpty) {
  QuantizedFile file;
  file.bake.haar = HaarTransfer{2, 1, 0, std::vector<std::uint32_t>(file.scene.vertexCount() + 1, 0), {}, {}};
  const HaarTransfer read = *file.readBack().haar;
  EXPECT_EQ(read.offsets, file.bake.haar->offsets);
  EXPECT_TRUE(read.indices.empty());
}

TEST(BakedQuantized, NumbersBeyondHalves_StayFloats) {
  QuantizedFile file;
  file.bake.lightGroups->coefficients[1] = 1e6f;
  const Bake read = file.readBack();
  EXPECT_EQ(read.lightGroups->coefficients[1], 1e6f);
}

TEST(BakedQuantized, NumberThatIsNotFinite_IsRefusedAsInFloats) {
  QuantizedFile file;
  file.bake.ao[1] = std::nanf("");
  EXPECT_THROW(embedBake(file.document, file.scene, file.bake, &file.forms), Error);
}

/// Appends halves as an accessor and returns its index.
int halves(GltfDocument& document, const std::vector<float>& numbers) {
  return appendValues(document, halvesOf(numbers));
}

struct Spoiling {
  const char* name;
  std::function<void(GltfDocument&, Json& quantized)> spoil;
  const char* expected;
};

std::ostream& operator<<(std::ostream& out, const Spoiling& s) { return out << s.name; }

class SpoiltColumn : public testing::TestWithParam<Spoiling> {};

TEST_P(SpoiltColumn, Read_ThrowsNamingThePlace) {
  QuantizedFile file;
  file.readBack();
  GetParam().spoil(file.document, file.entry()["quantized"]);
  const std::string message = test::inputErrorOf([&] { readBake(file.document, file.scene); });
  EXPECT_NE(message.find(GetParam().expected), std::string::npos) << message;
  EXPECT_NO_THROW(quantizedBytes(file.document));
}

Json& accessorOf(GltfDocument& document, const Json& index) {
  return document.json["accessors"][index.get<std::size_t>()];
}

INSTANTIATE_TEST_SUITE_P(
    Table, SpoiltColumn,
    testing::Values(
        Spoiling{"NoSuchAccessor", [](auto&, Json& q) { q["ao"]["bytes"] = 9999; }, "quantized/ao/bytes"},
        Spoiling{"NoBytes", [](auto&, Json& q) { q["ao"].erase("bytes"); }, "quantized/ao"},
        Spoiling{"Floats", [](auto&, Json& q) { q["ao"]["bytes"] = 0; }, "quantized/ao/bytes"},
        Spoiling{
            "FewerBytes",
            [](GltfDocument& d, Json& q) { accessorOf(d, q["horizons"]["angles"]["bytes"])["count"] = 14; },
            "angles/bytes: expected 15 values, got 14"},
        Spoiling{"PastTheView",
                 [](GltfDocument& d, Json& q) { accessorOf(d, q["ao"]["bytes"])["count"] = 4000; },
                 "accessors"},
        Spoiling{"Vectors", [](auto&, Json& q) { q["ao"]["bytes"] = q["bentNormal"]["bytes"]; },
                 "ao/bytes: expected an accessor of type SCALAR"},
        Spoiling{"NegativeScale", [](auto&, Json& q) { q["thickness"]["scale"] = -1.0; }, "thickness/scale"},
        Spoiling{"NoScale", [](auto&, Json& q) { q["thickness"]["scale"] = 0.0; }, "thickness/scale"},
        Spoiling{"HugeScale", [](auto&, Json& q) { q["thickness"]["scale"] = 1e300; }, "thickness/scale"},
        Spoiling{"TextScale", [](auto&, Json& q) { q["thickness"]["scale"] = "1"; }, "thickness/scale"},
        Spoiling{"TextSquare", [](auto&, Json& q) { q["ao"]["square"] = 2; }, "ao/square"},
        Spoiling{"BothScales", [](auto&, Json& q) { q["glossy"]["matrices"]["scale"] = 1.0; },
                 "matrices/scale: expected scale or scales"},
        Spoiling{"UnevenScales",
                 [](GltfDocument& d, Json& q) {
                   q["glossy"]["matrices"]["scales"] = halves(d, std::vector<float>(7, 1.0f));
                 },
                 "matrices/scales: 7 scales do not divide 144"},
        Spoiling{"NanScales",
                 [](GltfDocument& d, Json& q) {
                   q["glossy"]["matrices"]["scales"] = halves(d, std::vector<float>(36, std::nanf("")));
                 },
                 "matrices/scales: expected finite"},
        Spoiling{"InfiniteScales",
                 [](GltfDocument& d, Json& q) {
                   q["nearLamps"]["halves"]["scales"] = halves(d, std::vector<float>(9, 1e9f));
                 },
                 "halves/scales: expected finite"},
        Spoiling{"NegativeScales",
                 [](GltfDocument& d, Json& q) {
                   q["ch"]["coefficients"]["scales"] = halves(d, std::vector<float>(9, -1.0f));
                 },
                 "coefficients/scales: expected finite"},
        Spoiling{"ScalesOfOtherRows",
                 [](GltfDocument& d, Json& q) {
                   q["haar"]["values"]["scales"] = halves(d, std::vector<float>(8, 1.0f));
                 },
                 "values/scales: expected 9 values, got 8"},
        Spoiling{"RowsWithoutScales", [](auto&, Json& q) { q["haar"]["values"].erase("scales"); },
                 "haar/values: expected scales"},
        Spoiling{"TruncatedGaps",
                 [](GltfDocument& d, Json& q) {
                   Json& accessor = accessorOf(d, q["haar"]["indices"]["gaps"]);
                   accessor["count"] = accessor["count"].get<int>() - 1;
                 },
                 "indices/gaps: expected the gaps of"},
        Spoiling{"OffsetsThatFall",
                 [](GltfDocument& d, Json& q) {
                   std::vector<std::uint32_t> offsets(10, 5);
                   offsets[0] = 0;
                   offsets[9] = 4;
                   q["haar"]["offsets"] = appendValues(d, offsets);
                 },
                 "haar/offsets"},
        Spoiling{"HugeOffsets",
                 [](GltfDocument& d, Json& q) {
                   std::vector<std::uint32_t> offsets(10, 0);
                   offsets[9] = 0xffffffffu;
                   q["haar"]["offsets"] = appendValues(d, offsets);
                 },
                 "indices/gaps"},
        Spoiling{"AnglesBeyond", [](auto&, Json& q) { q["horizons"]["angles"]["scale"] = 100.0; },
                 "horizons/angles: expected angles"},
        Spoiling{"OnOneNodeAlone", [](auto&, Json& q) { q.erase("horizons"); }, "the same techniques"},
        Spoiling{"NotAnObject", [](auto&, Json& q) { q = 3; }, "quantized"}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(BakedQuantized, BytesOfMembers_AreThoseOfTheirAccessors) {
  QuantizedFile file;
  file.readBack();
  const std::size_t n = file.scene.vertexCount();
  const QuantizedBytes bytes = quantizedBytes(file.document);
  EXPECT_EQ(bytes.at("ao"), n);
  EXPECT_EQ(bytes.at("bentNormal"), 3 * n);
  EXPECT_EQ(bytes.at("glossy"), n * (48 + 12 * 2));
}

TEST(BakedQuantized, BytesOfBrokenFiles_AreThoseOfWhatIsWhole) {
  QuantizedFile file;
  file.readBack();
  const std::size_t ofNode = quantizedBytes(file.document).at("ao") / 2;
  const auto bytesAfter = [&](const std::function<void(GltfDocument&)>& spoil) {
    GltfDocument spoilt = file.document;
    spoil(spoilt);
    return quantizedBytes(spoilt)["ao"];
  };
  const auto entryOf = [](GltfDocument& document) -> Json& {
    return document.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"][0];
  };
  EXPECT_EQ(bytesAfter([&](GltfDocument& d) { entryOf(d)["quantized"]["ao"]["bytes"] = 9999; }), ofNode);
  EXPECT_EQ(bytesAfter([&](GltfDocument& d) { entryOf(d) = 3; }), ofNode);
  EXPECT_EQ(bytesAfter([](GltfDocument& d) { d.json["nodes"][0]["extensions"]["PRELIGHT_transfer"] = 3; }),
            ofNode);
  EXPECT_EQ(bytesAfter([](GltfDocument& d) { d.json["nodes"][0]["extensions"] = 3; }), ofNode);
  EXPECT_EQ(bytesAfter([](GltfDocument& d) { d.json["nodes"][0] = 3; }), ofNode);
  EXPECT_EQ(bytesAfter([](GltfDocument& d) { d.json["extensions"]["PRELIGHT_transfer"] = 3; }), 2 * ofNode);
  EXPECT_EQ(bytesAfter([&](GltfDocument& d) {
              d.json["accessors"][entryOf(d)["quantized"]["ao"]["bytes"].get<std::size_t>()] = 3;
            }),
            ofNode);
  EXPECT_EQ(bytesAfter([](GltfDocument& d) { d.json.erase("accessors"); }), 0u);
  EXPECT_EQ(bytesAfter([](GltfDocument& d) { d.json["nodes"] = "none"; }), 0u);
}

/// Bytes of a file are changed at random places: reading either throws InputError or gives finite numbers.
TEST(BakedQuantized, DamagedBytes_NeverGiveAnythingBroken) {
  QuantizedFile file;
  const std::size_t own = file.document.bin.size();
  file.readBack();
  std::mt19937 random(5);
  for (int trial = 0; trial < 300; ++trial) {
    GltfDocument damaged = file.document;
    for (int change = 0; change < 4; ++change)
      damaged.bin[own + random() % (damaged.bin.size() - own)] = static_cast<std::uint8_t>(random());
    try {
      const Bake read = readBake(damaged, file.scene).value();
      for (const float value : read.glossy->matrices) ASSERT_TRUE(std::isfinite(value));
      for (const float value : read.haar->values) ASSERT_TRUE(std::isfinite(value));
      for (const std::uint32_t index : read.haar->indices) ASSERT_LT(index, 6u * 32u * 32u);
    } catch (const InputError&) {
    }
  }
}

/// Numbers of matrices of few principal components, as those of a real scene.
GlossyTransfer plainMatrices(std::size_t vertices) {
  GlossyTransfer glossy{2, 3, 1, {}};
  const std::vector<float> axes = between(-1.0f, 1.0f, 3 * 48, 31);
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::vector<float> weights = between(-1.0f, 1.0f, 3, unsigned(v));
    for (std::size_t i = 0; i < 48; ++i)
      glossy.matrices.push_back(weights[0] * axes[i] + weights[1] * axes[48 + i] + weights[2] * axes[96 + i]);
  }
  return glossy;
}

/// The shapes with matrices that are stored by their principal components.
struct ComponentsFile {
  GltfDocument document = makeBuiltinScene("shapes");
  CompiledScene scene = test::compileDocument(document);
  Bake bake;
  StoredForms forms;
  std::vector<std::string> notes;

  ComponentsFile() {
    bake.glossy = plainMatrices(scene.vertexCount());
    forms = compressBake({.everything = true}, scene, bake, notes);
    embedBake(document, scene, bake, &forms);
  }

  std::string refusal() const {
    return test::inputErrorOf([&] { readBake(document, scene); });
  }
};

TEST(BakedQuantized, MatricesOfFewComponents_AreStoredByThem) {
  GltfDocument document = makeBuiltinScene("shapes");
  const CompiledScene scene = test::compileDocument(document);
  Bake bake;
  bake.glossy = plainMatrices(scene.vertexCount());
  const std::vector<float> full = bake.glossy->matrices;
  std::vector<std::string> notes;
  const StoredForms forms = compressBake({.everything = true}, scene, bake, notes);
  ASSERT_TRUE(forms.matrices);
  EXPECT_EQ(forms.matrices->components, 3);
  EXPECT_EQ(bake.glossy->matrices, full);
  embedBake(document, scene, bake, &forms);
  const std::vector<float> read = readBake(document, scene)->glossy->matrices;
  ASSERT_EQ(read.size(), full.size());
  double squares = 0.0, errors = 0.0;
  for (std::size_t i = 0; i < full.size(); ++i) {
    squares += double(full[i]) * double(full[i]);
    errors += (double(read[i]) - double(full[i])) * (double(read[i]) - double(full[i]));
  }
  EXPECT_LT(std::sqrt(errors / squares), 0.012);
  EXPECT_EQ(read, decompress(*forms.matrices).coefficients);
}

TEST(BakedQuantized, ComponentsThatDoNotFit_AreRefused) {
  for (const auto& [member, value] : {std::pair("order", Json(9)), std::pair("order", Json(100)),
                                      std::pair("channels", Json(1)), std::pair("method", Json("cpca"))}) {
    ComponentsFile file;
    file.document.json["extensions"]["PRELIGHT_transfer"]["glossyCompressed"][member] = value;
    EXPECT_NE(file.refusal().find("glossyCompressed"), std::string::npos) << file.refusal();
  }
}

TEST(BakedQuantized, ComponentsOfSomePrimitivesAlone_AreRefused) {
  for (const bool first : {true, false}) {
    ComponentsFile file;
    const auto groups = groupRanges(file.scene);
    ASSERT_GE(groups.size(), 2u);
    const auto& [key, ranges] = first ? *groups.begin() : *groups.rbegin();
    Json& glossy = file.document.json["nodes"][std::size_t(key.first)]["extensions"]["PRELIGHT_transfer"]
                                     ["primitives"][std::size_t(key.second)]["quantized"]["glossy"];
    glossy.erase("compressed");
    glossy["matrices"] = appendVertices(file.document, file.bake.glossy->matrices, ranges, 48);
    EXPECT_NE(file.refusal().find(first ? "other primitives have matrices" : "expected compressed matrices"),
              std::string::npos)
        << file.refusal();
  }
}

TEST(BakedQuantized, MatrixThatIsNotFinite_IsLeftToTheFilesCheck) {
  GltfDocument document = makeBuiltinScene("shapes");
  const CompiledScene scene = test::compileDocument(document);
  Bake bake;
  bake.glossy = plainMatrices(scene.vertexCount());
  bake.glossy->matrices[5] = std::nanf("");
  std::vector<std::string> notes;
  const StoredForms forms = compressBake({.everything = true}, scene, bake, notes);
  EXPECT_FALSE(forms.matrices);
  EXPECT_EQ(bake.glossy->matrices.size(), 48 * scene.vertexCount());
  EXPECT_THROW(embedBake(document, scene, bake, &forms), Error);
}

}  // namespace
}  // namespace prelight
