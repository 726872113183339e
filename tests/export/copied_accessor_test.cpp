#include "export/exported_vertices.h"

#include <gtest/gtest.h>

#include "scene/gltf/accessor.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

TEST(CopiedAccessor, Elements_ComeInTheOrderOfTheSource) {
  GltfDocument document = test::triangleDocument();
  const std::vector<std::uint32_t> source = {2, 0, 2, 1};
  const int copy = copyVertexAccessor(document, 0, source);
  EXPECT_EQ(AccessorReader(document, static_cast<std::size_t>(copy)).floats(),
            (std::vector<float>{0, 1, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0}));
}

TEST(CopiedAccessor, Negated_TurnsVectorsAround) {
  GltfDocument document = test::triangleDocument();
  const std::vector<std::uint32_t> source = {1, 2};
  const std::vector<std::uint8_t> negated = {1, 0};
  const int copy = copyVertexAccessor(document, 1, source, negated);
  EXPECT_EQ(AccessorReader(document, static_cast<std::size_t>(copy)).floats(),
            (std::vector<float>{0, 0, -1, 0, 0, 1}));
}

/// A vertex attribute may not have a stride of three bytes per element.
TEST(CopiedAccessor, Bytes_AreAlignedAndStayNormalized) {
  GltfDocument document = test::triangleDocument();
  const int colors = test::appendBytes(document, {255, 0, 51, 102, 153, 204, 0, 255, 0}, "VEC3", 3, 5121);
  document.json["accessors"][static_cast<std::size_t>(colors)]["normalized"] = true;
  const std::vector<std::uint32_t> source = {1, 0};
  const auto copy =
      static_cast<std::size_t>(copyVertexAccessor(document, static_cast<std::size_t>(colors), source));
  const auto view = document.json["accessors"][copy]["bufferView"].get<std::size_t>();
  EXPECT_EQ(document.json["bufferViews"][view]["byteStride"], 4);
  EXPECT_EQ(AccessorReader(document, copy).floats(),
            (std::vector<float>{0.4f, 0.6f, 0.8f, 1.0f, 0.0f, 0.2f}));
}

TEST(CopiedAccessor, SparseValues_AreFilledIn) {
  GltfDocument document = test::triangleDocument();
  const int indices = test::appendBytes(document, {1}, "SCALAR", 1, 5121);
  const int values = test::appendFloats(document, {7, 8, 9}, "VEC3");
  const auto viewOf = [&](int accessor) {
    return document.json["accessors"][static_cast<std::size_t>(accessor)]["bufferView"];
  };
  document.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", viewOf(indices)}, {"componentType", 5121}}},
      {"values", {{"bufferView", viewOf(values)}}}};
  const std::vector<std::uint32_t> source = {1, 2};
  const int copy = copyVertexAccessor(document, 0, source);
  EXPECT_EQ(AccessorReader(document, static_cast<std::size_t>(copy)).floats(),
            (std::vector<float>{7, 8, 9, 0, 1, 0}));
}

}  // namespace
}  // namespace prelight
