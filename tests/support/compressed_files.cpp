#include "support/compressed_files.h"

#include <draco/compression/encode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <memory>
#include <set>
#include <span>
#include <string_view>

#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_embed.h"

namespace prelight::test {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* draco = "KHR_draco_mesh_compression";

struct EncodedMesh {
  std::vector<std::uint8_t> bytes;
  Json attributes = Json::object();  ///< Attribute name to number.
};

/// Adds an attribute as floats, or as the 16-bit integers of an accessor of KHR_mesh_quantization. Returns
/// its number.
int addAttribute(::draco::Mesh& mesh, ::draco::GeometryAttribute::Type type, const AccessorReader& reader) {
  constexpr int uint16 = 5123;
  const bool isInteger = reader.componentType() == uint16;
  const std::vector<float> values = reader.floats();
  const std::vector<std::uint16_t> integers(values.begin(), values.end());
  const auto components = static_cast<std::int8_t>(reader.components());
  ::draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, components, isInteger ? ::draco::DT_UINT16 : ::draco::DT_FLOAT32, false,
                 components * (isInteger ? 2 : 4), 0);
  const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(reader.count()));
  for (std::uint32_t i = 0; i < reader.count(); ++i) {
    const std::size_t first = i * static_cast<std::size_t>(components);
    const void* value = isInteger ? static_cast<const void*>(&integers[first]) : &values[first];
    mesh.attribute(id)->SetAttributeValue(::draco::AttributeValueIndex(i), value);
  }
  return id;
}

EncodedMesh encodePrimitive(const GltfDocument& document, const Json& primitive,
                            const DracoEncoding& encoding) {
  using Type = ::draco::GeometryAttribute::Type;
  ::draco::Mesh mesh;
  EncodedMesh encoded;
  for (const auto& [name, type] : {std::pair<const char*, Type>{"POSITION", Type::POSITION},
                                   {"NORMAL", Type::NORMAL},
                                   {"TEXCOORD_0", Type::TEX_COORD}}) {
    if (!primitive.at("attributes").contains(name)) continue;
    const AccessorReader reader(document, primitive.at("attributes").at(name).get<std::size_t>());
    mesh.set_num_points(static_cast<std::uint32_t>(reader.count()));
    const int id = addAttribute(mesh, type, reader);
    encoded.attributes[name] = mesh.attribute(id)->unique_id();
  }
  const std::vector<std::uint32_t> indices =
      AccessorReader(document, primitive.at("indices").get<std::size_t>()).unsignedIntegers();
  for (std::size_t i = 0; i < indices.size(); i += 3)
    mesh.AddFace({::draco::PointIndex(indices[i]), ::draco::PointIndex(indices[i + 1]),
                  ::draco::PointIndex(indices[i + 2])});
  ::draco::Encoder encoder;
  encoder.SetEncodingMethod(encoding.edgebreaker ? ::draco::MESH_EDGEBREAKER_ENCODING
                                                 : ::draco::MESH_SEQUENTIAL_ENCODING);
  if (encoding.positionBits > 0) encoder.SetAttributeQuantization(Type::POSITION, encoding.positionBits);
  if (encoding.normalBits > 0) encoder.SetAttributeQuantization(Type::NORMAL, encoding.normalBits);
  ::draco::EncoderBuffer buffer;
  const ::draco::Status status = encoder.EncodeMeshToBuffer(mesh, &buffer);
  EXPECT_TRUE(status.ok()) << status.error_msg_string();
  encoded.bytes.assign(buffer.data(), buffer.data() + buffer.size());
  return encoded;
}

/// Removes the data of `accessors`, as a writer of compressed files would: nothing of their views stays in
/// the buffer.
void dropData(GltfDocument& document, const std::set<std::size_t>& accessors) {
  for (const std::size_t index : accessors) {
    Json& accessor = document.json["accessors"][index];
    const auto view = accessor["bufferView"].get<std::size_t>();
    const auto offset = document.json["bufferViews"][view].value("byteOffset", std::size_t{0});
    const auto length = document.json["bufferViews"][view]["byteLength"].get<std::size_t>();
    std::fill_n(document.bin.begin() + static_cast<std::ptrdiff_t>(offset), length, std::uint8_t{0xCD});
    accessor.erase("bufferView");
  }
}

void require(GltfDocument& document, const std::string& extension) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) document.json[list].push_back(extension);
}

template <class Encode>
std::vector<std::uint8_t> encoded(std::size_t bound, Encode encode) {
  std::vector<std::uint8_t> bytes(bound);
  bytes.resize(encode(bytes.data(), bytes.size()));
  return bytes;
}

/// Compressed stream of an accessor, whose bytes are `data`.
std::vector<std::uint8_t> streamOf(const AccessorReader& reader, const std::uint8_t* data, std::size_t stride,
                                   const std::string& mode) {
  if (mode == "ATTRIBUTES") return meshoptAttributes(data, reader.count(), stride);
  return mode == "TRIANGLES" ? meshoptTriangles(reader.unsignedIntegers())
                             : meshoptSequence(reader.unsignedIntegers());
}

}  // namespace

GltfDocument withDraco(const GltfDocument& document, const DracoEncoding& encoding) {
  GltfDocument result = document;
  std::set<std::size_t> filled;
  for (Json& mesh : result.json["meshes"]) {
    for (Json& primitive : mesh["primitives"]) {
      const EncodedMesh encodedMesh = encodePrimitive(document, primitive, encoding);
      primitive["extensions"][draco] = {{"bufferView", appendBufferView(result, encodedMesh.bytes)},
                                        {"attributes", encodedMesh.attributes}};
      filled.insert(primitive["indices"].get<std::size_t>());
      for (const auto& attribute : encodedMesh.attributes.items())
        filled.insert(primitive["attributes"][attribute.key()].get<std::size_t>());
    }
  }
  dropData(result, filled);
  require(result, draco);
  return result;
}

void compressView(GltfDocument& document, std::size_t view, const std::vector<std::uint8_t>& stream,
                  Json layout, const std::string& extension) {
  const std::size_t offset = prelight::appendBytes(document, stream);
  Json& json = document.json["bufferViews"][view];
  layout["buffer"] = 0;
  layout["byteOffset"] = offset;
  layout["byteLength"] = stream.size();
  json["byteLength"] = layout["count"].get<std::size_t>() * layout["byteStride"].get<std::size_t>();
  json["buffer"] = 1;
  json["byteOffset"] = 0;
  json["extensions"][extension] = std::move(layout);
  std::size_t fallbackBytes = 0;
  for (const Json& other : document.json["bufferViews"]) {
    if (other["buffer"] == 1) fallbackBytes = std::max(fallbackBytes, other["byteLength"].get<std::size_t>());
  }
  // Only one buffer remains after the append.
  document.json["buffers"].push_back(
      {{"byteLength", fallbackBytes}, {"extensions", {{extension, {{"fallback", true}}}}}});
}

GltfDocument withMeshopt(const GltfDocument& document, const std::string& extension,
                         const std::string& indexMode) {
  GltfDocument result = document;
  std::set<std::size_t> done;
  for (const Json& mesh : document.json["meshes"]) {
    for (const Json& primitive : mesh["primitives"]) {
      std::vector<std::size_t> accessors = {primitive["indices"].get<std::size_t>()};
      for (const auto& attribute : primitive["attributes"].items())
        accessors.push_back(attribute.value().get<std::size_t>());
      for (const std::size_t index : accessors) {
        const auto view = document.json["accessors"][index]["bufferView"].get<std::size_t>();
        if (!done.insert(view).second) continue;
        const AccessorReader reader(document, index);
        const std::size_t stride =
            reader.components() * componentBytes(static_cast<std::uint64_t>(reader.componentType()));
        const auto offset = document.json["bufferViews"][view].value("byteOffset", std::size_t{0});
        const std::string mode = index == accessors[0] ? indexMode : "ATTRIBUTES";
        compressView(result, view, streamOf(reader, &document.bin[offset], stride, mode),
                     {{"byteStride", stride}, {"count", reader.count()}, {"mode", mode}}, extension);
        std::fill_n(result.bin.begin() + static_cast<std::ptrdiff_t>(offset), reader.count() * stride,
                    std::uint8_t{0xCD});
      }
    }
  }
  require(result, extension);
  return result;
}

std::vector<std::uint8_t> meshoptAttributes(const void* data, std::size_t count, std::size_t stride) {
  return encoded(meshopt_encodeVertexBufferBound(count, stride), [&](std::uint8_t* out, std::size_t size) {
    return meshopt_encodeVertexBuffer(out, size, data, count, stride);
  });
}

std::vector<std::uint8_t> meshoptTriangles(const std::vector<std::uint32_t>& indices) {
  return encoded(meshopt_encodeIndexBufferBound(indices.size(), indices.size()),
                 [&](std::uint8_t* out, std::size_t size) {
                   return meshopt_encodeIndexBuffer(out, size, indices.data(), indices.size());
                 });
}

std::vector<std::uint8_t> meshoptSequence(const std::vector<std::uint32_t>& indices) {
  const std::size_t vertices = *std::max_element(indices.begin(), indices.end()) + std::size_t{1};
  return encoded(meshopt_encodeIndexSequenceBound(indices.size(), vertices),
                 [&](std::uint8_t* out, std::size_t size) {
                   return meshopt_encodeIndexSequence(out, size, indices.data(), indices.size());
                 });
}

}  // namespace prelight::test
