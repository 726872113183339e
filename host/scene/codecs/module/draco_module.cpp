#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>

#include <cstring>
#include <utility>

#include "prelight/error.h"
#include "scene/codecs/draco_mesh.h"

namespace prelight {

namespace {

/// Returns the least number of bytes that arrays of so many triangles and vertices take; `seams` counts the
/// attributes with triangles of their own. Products of 32-bit numbers and small ones do not overflow.
std::uint64_t connectivityBytes(std::uint64_t triangles, std::uint64_t vertices, std::uint64_t seams) {
  constexpr std::uint64_t triangleBytes = 12;
  constexpr std::uint64_t vertexBytes = 4;
  return triangles * triangleBytes * (2 + seams) + vertices * vertexBytes;
}

/// Reads the counts at the beginning of the connectivity, which bitstreams of all versions have.
class ClaimReader {
 public:
  explicit ClaimReader(const draco::DecoderBuffer& buffer) : buffer_(buffer) {}

  std::uint64_t byte() {
    std::uint8_t value = 0;
    return buffer_.Decode(&value) ? value : 0;
  }
  std::uint64_t number(bool fixed) {
    std::uint32_t value = 0;
    const bool read = fixed ? buffer_.Decode(&value) : draco::DecodeVarint(&value, &buffer_);
    return read ? value : 0;
  }

 private:
  draco::DecoderBuffer buffer_;
};

constexpr std::uint16_t version20 = DRACO_BITSTREAM_VERSION(2, 0);
constexpr std::uint16_t version22 = DRACO_BITSTREAM_VERSION(2, 2);

/// A decoder that stops before it would take more memory than permitted.
template <class Decoder>
class Bounded : public Decoder {
 public:
  explicit Bounded(std::uint64_t mostBytes) : mostBytes_(mostBytes) {}

  std::uint64_t wantedBytes() const { return wantedBytes_; }
  bool isRefused() const { return wantedBytes_ > mostBytes_; }

 protected:
  bool DecodeConnectivity() override {
    wantedBytes_ = claimedBytes();
    return !isRefused() && Decoder::DecodeConnectivity();
  }

  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    for (int i = 0; i < cloud.num_attributes(); ++i) {
      const draco::PointAttribute& attribute = *cloud.attribute(i);
      // The values, the integers from which they are decoded, and the indices of the vertices that have them.
      const auto components = static_cast<std::uint64_t>(attribute.num_components());
      const auto size = static_cast<std::uint64_t>(draco::DataTypeLength(attribute.data_type()));
      wantedBytes_ += std::uint64_t{cloud.num_points()} * (components * (size + 4) + 4);
      if (isRefused()) return false;
    }
    return Decoder::DecodeAllAttributes();
  }

 private:
  std::uint64_t claimedBytes() {
    ClaimReader reader(*this->buffer());
    const std::uint16_t version = this->bitstream_version();
    if constexpr (std::is_same_v<Decoder, draco::MeshSequentialDecoder>) {
      const std::uint64_t triangles = reader.number(version < version22);
      const std::uint64_t vertices = reader.number(version < version22);
      return connectivityBytes(triangles, vertices, 0);
    } else {
      const bool fixed = version < version20;
      const std::uint64_t more = version < version22 ? reader.number(fixed) : 0;
      const std::uint64_t vertices = reader.number(fixed);
      const std::uint64_t triangles = reader.number(fixed);
      const std::uint64_t seams = reader.byte();
      const std::uint64_t symbols = reader.number(fixed);
      return connectivityBytes(triangles, more + vertices + symbols, seams);
    }
  }

  std::uint64_t mostBytes_;
  std::uint64_t wantedBytes_ = 0;
};

constexpr const char* exportAgain = "the data are damaged, or export the scene without Draco";

template <class Decoder>
void decodeWith(draco::DecoderBuffer& buffer, std::uint64_t mostBytes, const std::string& where,
                draco::Mesh& mesh) {
  Bounded<Decoder> decoder(mostBytes);
  const draco::DecoderOptions options;
  const draco::Status status = decoder.Decode(options, &buffer, &mesh);
  if (decoder.isRefused())
    throw InputError(
        where,
        fmt::format("the Draco data claim a mesh of {} bytes at least, expected at most {} for so "
                    "small a file",
                    decoder.wantedBytes(), mostBytes),
        exportAgain);
  if (!status.ok())
    throw InputError(where,
                     fmt::format("the Draco data cannot be decoded{}{}",
                                 status.error_msg_string().empty() ? "" : ": ", status.error_msg_string()),
                     exportAgain);
}

template <class Stored>
std::vector<std::uint8_t> convertedValues(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                                          const std::string& where) {
  const auto components = static_cast<std::size_t>(attribute.num_components());
  const std::size_t bytes = components * sizeof(Stored);
  std::vector<std::uint8_t> values(mesh.num_points() * bytes);
  std::vector<Stored> element(components);
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(i));
    const bool converted =
        index.value() < attribute.size() &&
        attribute.ConvertValue<Stored>(index, static_cast<std::int8_t>(components), element.data());
    if (!converted)
      throw InputError(where, fmt::format("value {} of the Draco data does not fit the accessor", i),
                       exportAgain);
    std::memcpy(&values[i * bytes], element.data(), bytes);
  }
  return values;
}

std::unique_ptr<draco::Mesh> decodedMesh(std::span<const std::uint8_t> bytes, std::uint64_t mostBytes,
                                         const std::string& where) {
  auto mesh = std::make_unique<draco::Mesh>();
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::DecoderBuffer start(buffer);
  draco::DracoHeader header{};
  if (!draco::PointCloudDecoder::DecodeHeader(&start, &header).ok())
    throw InputError(where, "these are no data of Draco", exportAgain);
  if (header.encoder_type != draco::TRIANGULAR_MESH)
    throw InputError(where, "the Draco data hold points, expected triangles", exportAgain);
  if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
    decodeWith<draco::MeshSequentialDecoder>(buffer, mostBytes, where, *mesh);
  } else if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    decodeWith<draco::MeshEdgebreakerDecoder>(buffer, mostBytes, where, *mesh);
  } else {
    throw InputError(where,
                     fmt::format("method {} of Draco is not known, expected 0 or 1", header.encoder_method),
                     exportAgain);
  }
  return mesh;
}

class DecodedDraco final : public DracoMesh {
 public:
  explicit DecodedDraco(std::unique_ptr<draco::Mesh> mesh) : mesh_(std::move(mesh)) {}

  std::size_t vertices() const override { return mesh_->num_points(); }

  std::size_t triangles() const override { return mesh_->num_faces(); }

  std::vector<std::uint32_t> indices() const override {
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{mesh_->num_faces()} * 3);
    for (std::uint32_t i = 0; i < mesh_->num_faces(); ++i) {
      for (const draco::PointIndex& vertex : mesh_->face(draco::FaceIndex(i)))
        indices.push_back(vertex.value());
    }
    return indices;
  }

  std::vector<std::uint8_t> values(const DracoValues& wanted, const std::string& where) const override {
    const draco::PointAttribute* attribute = mesh_->GetAttributeByUniqueId(wanted.attribute);
    if (attribute == nullptr)
      throw InputError(where, fmt::format("the Draco data have no attribute {}", wanted.attribute),
                       exportAgain);
    // A byte other than 0 and 1 is no bool, and libdraco reads it as one.
    if (attribute->data_type() == draco::DT_BOOL)
      throw InputError(where,
                       fmt::format("attribute {} of the Draco data has values of type bool, expected numbers",
                                   wanted.attribute),
                       exportAgain);
    const auto components = static_cast<std::size_t>(attribute->num_components());
    if (components != wanted.components)
      throw InputError(where,
                       fmt::format("attribute {} of the Draco data has {} components, the accessor {}",
                                   wanted.attribute, components, wanted.components),
                       exportAgain);
    constexpr std::uint64_t int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125;
    switch (wanted.componentType) {
      case int8:
        return convertedValues<std::int8_t>(*mesh_, *attribute, where);
      case uint8:
        return convertedValues<std::uint8_t>(*mesh_, *attribute, where);
      case int16:
        return convertedValues<std::int16_t>(*mesh_, *attribute, where);
      case uint16:
        return convertedValues<std::uint16_t>(*mesh_, *attribute, where);
      case uint32:
        return convertedValues<std::uint32_t>(*mesh_, *attribute, where);
      default:
        return convertedValues<float>(*mesh_, *attribute, where);
    }
  }

 private:
  std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace

}  // namespace prelight

extern "C" void prelightDecodeDraco(std::span<const std::uint8_t> bytes, std::uint64_t mostBytes,
                                    const std::string& where, std::unique_ptr<prelight::DracoMesh>& mesh) {
  auto decoded = std::make_unique<prelight::DecodedDraco>(prelight::decodedMesh(bytes, mostBytes, where));
  for (const std::uint32_t vertex : decoded->indices()) {
    if (vertex >= decoded->vertices())
      throw prelight::InputError(
          where, fmt::format("a triangle of the Draco data has vertex {} of {}", vertex, decoded->vertices()),
          prelight::exportAgain);
  }
  mesh = std::move(decoded);
}
