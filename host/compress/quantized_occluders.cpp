#include "compress/quantized_occluders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/directions.h"
#include "base/parallel.h"
#include "occluders/occluder_light.h"
#include "occluders/occluder_record.h"

namespace prelight {

namespace {

constexpr double leastMeaning = 1e-9;  // shortest distance that is told apart, m

/// Returns the integer in [0, most] that stands for a share in [0,1].
std::uint32_t stepOf(double share, std::uint32_t most) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * most));
}

class Writer {
 public:
  explicit Writer(std::uint8_t* bytes) : bytes_(bytes) {}
  void byte(std::uint32_t value) { *bytes_++ = static_cast<std::uint8_t>(value); }
  void word(std::uint32_t value) {
    byte(value & 0xffu);
    byte(value >> 8);
  }
  void share(double value) { byte(stepOf(value, 255)); }
  void direction8(const glm::dvec3& direction) {
    const Octahedral folded = toOctahedral(direction, 8);
    byte(folded.u);
    byte(folded.v);
  }
  void direction12(const glm::dvec3& direction) {
    const Octahedral folded = toOctahedral(direction, 12);
    const std::uint32_t both = folded.u | folded.v << 12;
    byte(both & 0xffu);
    word(both >> 8);
  }

 private:
  std::uint8_t* bytes_;
};

class OccluderBytes {
 public:
  explicit OccluderBytes(const std::uint8_t* bytes) : bytes_(bytes) {}
  std::uint32_t byte() { return *bytes_++; }
  std::uint32_t word() {
    const std::uint32_t low = byte();
    return low | byte() << 8;
  }
  double share() { return byte() / 255.0; }
  glm::dvec3 direction8() {
    const std::uint32_t u = byte();
    return fromOctahedral({u, byte()}, 8);
  }
  glm::dvec3 direction12() {
    const std::uint32_t low = byte(), both = low | word() << 8;
    return fromOctahedral({both & 0xfffu, both >> 12}, 12);
  }

 private:
  const std::uint8_t* bytes_;
};

/// Range of distances that are told apart.
struct Distances {
  double least = 1.0;
  double most = 1.0;

  std::uint32_t step(double distance) const {
    if (!(most > least)) return 0;
    return stepOf(std::log(std::max(distance, least) / least) / std::log(most / least), 0xffff);
  }
  double at(std::uint32_t step) const { return least * std::pow(most / least, step / 65535.0); }
};

Distances distancesOf(const OccluderTransfer& transfer) {
  const std::size_t width = transfer.stored.size(), place = placeOf(transfer, OccluderVector::Position);
  Distances distances{std::numeric_limits<double>::infinity(), leastMeaning};
  for (std::size_t r = 0; place < width && r < transfer.recordCount(); ++r) {
    const double distance = std::max(double(transfer.vectors[r * width + place].w), leastMeaning);
    distances.least = std::min(distances.least, distance);
    distances.most = std::max(distances.most, distance);
  }
  return distances.least <= distances.most ? distances : Distances{};
}

double ratio(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

void writeVector(OccluderVector kind, const glm::dvec4& vector, double formFactor, const glm::dvec3& vertex,
                 const Distances& distances, Writer& to) {
  const glm::dvec3 xyz(vector);
  switch (kind) {
    case OccluderVector::Position: {
      const std::uint32_t step = distances.step(vector.w);
      to.word(step);
      to.direction8(xyz - vertex);
      to.share(ratio(glm::length(xyz - vertex), distances.at(step)));
      break;
    }
    case OccluderVector::Occlusion:
      to.word(stepOf(std::sqrt(std::max(0.0, vector.w)), 0xffff));
      to.direction12(xyz);
      to.share(std::sqrt(std::max(0.0, 1.0 - ratio(glm::length(xyz), vector.w))));
      break;
    case OccluderVector::Caustic:
    case OccluderVector::DiffuseNormal:
    case OccluderVector::SpecularNormal:
      to.share(std::sqrt(std::max(0.0, ratio(vector.w, formFactor))));
      to.direction8(xyz);
      to.share(ratio(glm::length(xyz), vector.w));
      break;
    case OccluderVector::Transmissive:
    case OccluderVector::DiffuseColor:
    case OccluderVector::SpecularColor:
      for (int c = 0; c < 3; ++c) to.share(vector[c]);
      break;
  }
}

glm::dvec4 readVector(OccluderVector kind, double formFactor, const glm::dvec3& vertex,
                      const Distances& distances, OccluderBytes& from) {
  switch (kind) {
    case OccluderVector::Position: {
      const double distance = distances.at(from.word());
      const glm::dvec3 direction = from.direction8();
      return {vertex + from.share() * distance * direction, distance};
    }
    case OccluderVector::Occlusion: {
      from.word();
      const glm::dvec3 direction = from.direction12();
      const double spread = from.share();
      return {(1.0 - spread * spread) * formFactor * direction, formFactor};
    }
    case OccluderVector::Caustic:
    case OccluderVector::DiffuseNormal:
    case OccluderVector::SpecularNormal: {
      const double root = from.share(), weight = root * root * formFactor;
      const glm::dvec3 direction = from.direction8();
      return {from.share() * weight * direction, weight};
    }
    case OccluderVector::Transmissive:
    case OccluderVector::DiffuseColor:
    case OccluderVector::SpecularColor:
      break;
  }
  const double red = from.share(), green = from.share();
  return {red, green, from.share(), 0.0};
}

/// Returns the byte offset of occlusion in a record.
std::size_t occlusionByte(const std::vector<OccluderVector>& stored) {
  std::size_t at = 0;
  for (const OccluderVector vector : stored) {
    if (vector == OccluderVector::Occlusion) break;
    at += quantizedBytes(vector);
  }
  return at;
}

/// Returns cosine x visibility.
double lightOf(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
               const glm::dvec3& toLight) {
  const double cosine = glm::dot(receiver.normal, toLight);
  if (!(cosine > 0.0)) return 0.0;
  return cosine * visibilityOf(transfer, receiver, {.irradiance = glm::dvec3(1.0), .toLight = toLight}, {});
}

/// Returns direction i of a Fibonacci lattice, which is even over the sphere.
glm::dvec3 latticeDirection(int i, int count) {
  const double y = 1.0 - (2.0 * i + 1.0) / count, out = std::sqrt(1.0 - y * y);
  const double angle = 2.0 * std::numbers::pi * i / std::numbers::phi;
  return {out * std::cos(angle), y, out * std::sin(angle)};
}

}  // namespace

std::size_t quantizedBytes(OccluderVector vector) {
  switch (vector) {
    case OccluderVector::Position:
      return 5;
    case OccluderVector::Occlusion:
      return 6;
    case OccluderVector::Caustic:
    case OccluderVector::DiffuseNormal:
    case OccluderVector::SpecularNormal:
      return 4;
    case OccluderVector::Transmissive:
    case OccluderVector::DiffuseColor:
    case OccluderVector::SpecularColor:
      break;
  }
  return 3;
}

std::size_t quantizedBytes(const std::vector<OccluderVector>& stored) {
  std::size_t bytes = 0;
  for (const OccluderVector vector : stored) bytes += quantizedBytes(vector);
  return bytes;
}

QuantizedOccluders quantizeOccluders(const OccluderTransfer& transfer, std::span<const glm::dvec3> vertices) {
  const std::size_t width = transfer.stored.size(), occlusion = placeOf(transfer, OccluderVector::Occlusion);
  const Distances distances = distancesOf(transfer);
  QuantizedOccluders out{transfer.names,
                         transfer.stored,
                         transfer.offsets,
                         transfer.occluders,
                         distances.least,
                         distances.most,
                         {}};
  const std::size_t recordBytes = quantizedBytes(transfer.stored);
  out.bytes.resize(transfer.recordCount() * recordBytes);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    for (std::size_t r = transfer.offsets[v]; r < transfer.offsets[v + 1]; ++r) {
      const glm::vec4* record = transfer.vectors.data() + r * width;
      Writer to(out.bytes.data() + r * recordBytes);
      for (std::size_t s = 0; s < width; ++s)
        writeVector(transfer.stored[s], glm::dvec4(record[s]), record[occlusion].w, vertices[v], distances,
                    to);
    }
  return out;
}

void dequantizeRecord(const std::vector<OccluderVector>& stored, double leastDistance, double mostDistance,
                      const glm::dvec3& vertex, const std::uint8_t* bytes, glm::vec4* vectors) {
  const double root = OccluderBytes(bytes + occlusionByte(stored)).word() / 65535.0;
  OccluderBytes from(bytes);
  for (std::size_t s = 0; s < stored.size(); ++s)
    vectors[s] = glm::vec4(readVector(stored[s], root * root, vertex, {leastDistance, mostDistance}, from));
}

OccluderTransfer dequantizeOccluders(const QuantizedOccluders& quantized,
                                     std::span<const glm::dvec3> vertices) {
  OccluderTransfer out{quantized.names, quantized.stored, quantized.offsets, quantized.occluders, {}};
  const std::size_t width = out.stored.size(), recordBytes = quantizedBytes(out.stored);
  out.vectors.resize(out.recordCount() * width);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    for (std::size_t r = out.offsets[v]; r < out.offsets[v + 1]; ++r)
      dequantizeRecord(out.stored, quantized.leastDistance, quantized.mostDistance, vertices[v],
                       quantized.bytes.data() + r * recordBytes, out.vectors.data() + r * width);
  return out;
}

OccluderQuantizationError quantizationError(const OccluderTransfer& full, const OccluderTransfer& quantized,
                                            std::span<const glm::dvec3> vertices,
                                            std::span<const glm::vec3> normals) {
  constexpr int lights = 16;
  const std::size_t width = full.stored.size(), occlusion = placeOf(full, OccluderVector::Occlusion);
  OccluderQuantizationError error;
  for (std::size_t r = 0; r < full.recordCount(); ++r)
    error.formFactor =
        std::max(error.formFactor, std::abs(double(full.vectors[r * width + occlusion].w) -
                                            double(quantized.vectors[r * width + occlusion].w)));
  if (placeOf(full, OccluderVector::Position) == width ||
      placeOf(full, OccluderVector::DiffuseNormal) == width)
    return error;
  std::vector<glm::dvec2> sums(vertices.size(), glm::dvec2(0.0));  // squared differences, squared light
  parallelRanges(vertices.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const OccluderReceiver receiver{
          .vertex = static_cast<std::uint32_t>(v), .position = vertices[v], .normal = glm::dvec3(normals[v])};
      for (int i = 0; i < lights; ++i) {
        const glm::dvec3 toLight = latticeDirection(i, lights);
        const double light = lightOf(full, receiver, toLight);
        const double difference = lightOf(quantized, receiver, toLight) - light;
        sums[v] += glm::dvec2(difference * difference, light * light);
      }
    }
  });
  glm::dvec2 sum(0.0);
  for (const glm::dvec2& part : sums) sum += part;
  error.light = sum.y > 0.0 ? std::sqrt(sum.x / sum.y) : 0.0;
  return error;
}

}  // namespace prelight
