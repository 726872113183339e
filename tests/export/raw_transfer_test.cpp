#include "export/raw_arrays.h"

#include <gtest/gtest.h>

#include <cstring>

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
std::vector<T> arrayOf(const RawArrays& arrays, const std::string& name) {
  const Json& json = arrays.json().at(name);
  std::size_t count = 1;
  for (const Json& size : json["shape"]) count *= size.get<std::size_t>();
  const auto offset = json["byteOffset"].get<std::size_t>();
  std::vector<T> values(count);
  EXPECT_LE(offset + count * sizeof(T), arrays.bytes().size());
  std::memcpy(values.data(), &arrays.bytes()[offset], count * sizeof(T));
  return values;
}

TEST(RawTransfer, Wavelets_AreRowsOfCoefficients) {
  const HaarTransfer haar{4, 3, 1, {0, 2, 2, 3}, {1, 95, 7}, {0.5f, -0.25f, 2.0f}};
  RawArrays arrays;
  const Json said = addRawWavelets(haar, arrays);
  EXPECT_EQ(said["faceSize"], 4);
  EXPECT_EQ(said["channels"], 3);
  EXPECT_EQ(arrayOf<std::uint32_t>(arrays, "haar.offsets"), haar.offsets);
  EXPECT_EQ(arrayOf<std::uint32_t>(arrays, "haar.indices"), haar.indices);
  EXPECT_EQ(arrayOf<float>(arrays, "haar.values"), haar.values);
}

TEST(RawTransfer, Occluders_HaveRecordsOfTheirVectors) {
  OccluderTransfer occluders;
  occluders.names = {"table", "chair"};
  occluders.stored = {OccluderVector::Position, OccluderVector::Occlusion};
  occluders.offsets = {0, 1, 2};
  occluders.occluders = {1, 0};
  occluders.vectors = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}, {13, 14, 15, 16}};
  RawArrays arrays;
  const Json said = addRawOccluders(occluders, arrays);
  EXPECT_EQ(said["occluders"], Json({"table", "chair"}));
  EXPECT_EQ(said["stored"], Json({"position", "occlusion"}));
  EXPECT_EQ(arrays.json()["vo.vectors"]["shape"], Json({2, 2, 4}));
  EXPECT_EQ(arrayOf<float>(arrays, "vo.vectors").at(11), 12.0f);
  EXPECT_EQ(arrayOf<std::uint32_t>(arrays, "vo.occluders"), occluders.occluders);
}

TEST(RawTransfer, NoRecords_AreArraysOfNothing) {
  OccluderTransfer occluders;
  occluders.stored = {OccluderVector::Occlusion};
  occluders.offsets = {0, 0};
  RawArrays arrays;
  addRawOccluders(occluders, arrays);
  EXPECT_EQ(arrays.json()["vo.vectors"]["shape"], Json({0, 1, 4}));
}

TEST(RawTransfer, Compressed_HasTheArraysThatItsMethodUses) {
  CompressedTransfer bytes;
  bytes.method = CompressionMethod::Rgbe;
  bytes.order = 2;
  bytes.vertexCount = 2;
  bytes.bytes = {1, 2, 3, 4, 5, 6, 7, 8};
  bytes.exponents = {128, 129, 0, 130};
  RawArrays arrays;
  EXPECT_EQ(addRawCompressed(bytes, arrays)["method"], "rgbe");
  EXPECT_EQ(arrays.json()["shCompressed.bytes"]["shape"], Json({2, 1, 4}));
  EXPECT_EQ(arrayOf<std::uint8_t>(arrays, "shCompressed.exponents"), bytes.exponents);
  EXPECT_FALSE(arrays.json().contains("shCompressed.halves"));

  CompressedTransfer clustered;
  clustered.method = CompressionMethod::Cpca;
  clustered.order = 1;
  clustered.vertexCount = 3;
  clustered.clusters = 2;
  clustered.components = 1;
  clustered.means = {0.5f, 0.25f};
  clustered.basis = {1.0f, 1.0f};
  clustered.clusterOf = {0, 1, 1};
  clustered.weights = WeightStorage::Byte;
  clustered.weightBytes = {0, 128, 255};
  clustered.weightRanges = {0.0f, 0.1f, -1.0f, 0.2f};
  RawArrays more;
  EXPECT_EQ(addRawCompressed(clustered, more)["method"], "cpca");
  EXPECT_EQ(arrayOf<std::uint16_t>(more, "shCompressed.clusters"), clustered.clusterOf);
  EXPECT_EQ(arrayOf<std::uint8_t>(more, "shCompressed.weights"), clustered.weightBytes);
  EXPECT_EQ(more.json()["shCompressed.weightRanges"]["shape"], Json({2, 1, 2}));
}

}  // namespace
}  // namespace prelight
