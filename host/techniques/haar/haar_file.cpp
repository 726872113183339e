#include "techniques/haar/haar_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"

namespace prelight {

namespace {

using Json = Technique::Json;

constexpr std::uint64_t maxFaceSize = 1024;

/// Returns the parts of a scene's sparse rows that belong to ranges, one after the other.
template <typename T>
std::vector<T> gatherRows(const std::vector<T>& values, const HaarTransfer& haar,
                          const PrimitiveRanges& ranges) {
  const auto channels = static_cast<std::size_t>(haar.channels);
  std::vector<T> gathered;
  for (const PrimitiveRange& range : ranges) {
    const std::uint32_t first = haar.offsets[range.firstVertex * channels],
                        last = haar.offsets[(range.firstVertex + range.vertexCount) * channels];
    const auto rows = std::span(values).subspan(first, last - first);
    gathered.insert(gathered.end(), rows.begin(), rows.end());
  }
  // glTF has no accessor of 0 elements: rows that are all empty point at nothing.
  if (gathered.empty()) gathered.push_back(0);
  return gathered;
}

int appendIndices(GltfDocument& document, const std::vector<std::uint32_t>& indices, std::size_t bytes) {
  if (bytes == sizeof(std::uint32_t)) return appendValues(document, indices);
  return appendValues(document, std::vector<std::uint16_t>(indices.begin(), indices.end()));
}

/// Adds indices and values as bytes.
void addQuantizedRows(const BakedOutput& output, std::string_view name, const HaarTransfer& haar,
                      const PrimitiveRanges& ranges, std::span<const std::uint32_t> ends, Json& json) {
  const std::vector<std::uint32_t> indices = gatherRows(haar.indices, haar, ranges);
  std::vector<std::uint8_t> gaps = encodeGaps(indices, ends);
  if (gaps.empty()) gaps.push_back(0);  // glTF has no accessor of 0 elements
  json["indices"] = {{"gaps", appendValues(output.document, gaps)}};
  ColumnSavings& saved = (*output.saved)[std::string(name)];
  saved.plainBytes += indices.size() * haar.storedIndexBytes();
  saved.bytes += gaps.size();
  json["values"] = appendQuantized(output.document, gatherRows(haar.values, haar, ranges), {.square = true},
                                   "SCALAR", 1, ends, saved);
}

void checkOffsets(const JsonCursor& json, const std::vector<std::uint32_t>& offsets) {
  if (offsets.front() != 0 || !std::is_sorted(offsets.begin(), offsets.end()))
    json.at("offsets").fail("expected offsets that ascend from 0 to the number of indices at most", rebake);
}

void checkRows(const JsonCursor& json, int faceSize, const std::vector<std::uint32_t>& offsets,
               const std::vector<std::uint32_t>& indices) {
  if (offsets.back() > indices.size())
    json.at("offsets").fail("expected offsets that ascend from 0 to the number of indices at most", rebake);
  const auto size = static_cast<std::uint32_t>(faceSize);
  for (std::size_t row = 0; row + 1 < offsets.size(); ++row)
    for (std::uint32_t i = offsets[row]; i < offsets[row + 1]; ++i)
      if (indices[i] >= 6 * size * size || (i > offsets[row] && indices[i] <= indices[i - 1]))
        json.at("indices").fail(fmt::format("index {} of row {} is {}, expected ascending indices below {}",
                                            i - offsets[row], row, indices[i], 6 * size * size),
                                rebake);
}

/// Sets what all primitives share, or compares it.
void readHeader(const JsonCursor& json, std::optional<HaarTransfer>& target) {
  HaarTransfer header;
  header.faceSize = readNumber(json.at("faceSize"), 1, maxFaceSize);
  if (!std::has_single_bit(static_cast<unsigned>(header.faceSize)))
    json.at("faceSize").fail(fmt::format("expected a power of two, got {}", header.faceSize), rebake);
  header.channels = readChannels(json);
  header.bounces = readBounces(json);
  if (!target) target = header;
  expectSame(json,
             header.faceSize == target->faceSize && header.channels == target->channels &&
                 header.bounces == target->bounces,
             "face size, channels and bounces");
}

class HaarReader final : public TechniqueReader {
 public:
  explicit HaarReader(const BakedInput& input) : rows_(input) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    if (const auto json = entry.find("haar")) rows_.read(*json, ranges, bake.haar);
  }

  void finish(Bake& bake) override {
    if (bake.haar) rows_.finish(*bake.haar);
  }

 private:
  HaarRowsReader rows_;
};

}  // namespace

std::vector<std::uint32_t> HaarRowsReader::readIndices(const JsonCursor& json,
                                                       const std::vector<std::uint32_t>& offsets) const {
  if (!json.value().is_object()) return values_.shortOrLongIntegers(json);
  if (offsets.back() == 0) return {0};  // one that no row has
  const auto indices = decodeGaps(values_.integers<std::uint8_t>(json.at("gaps"), std::nullopt),
                                  std::span(offsets).subspan(1));
  if (!indices) json.at("gaps").fail(fmt::format("expected the gaps of {} indices", offsets.back()), rebake);
  return *indices;
}

void HaarRowsReader::read(const JsonCursor& json, const PrimitiveRanges& ranges,
                          std::optional<HaarTransfer>& target) {
  readHeader(json, target);
  const auto channels = static_cast<std::size_t>(target->channels);
  const auto offsets =
      values_.integers<std::uint32_t>(json.at("offsets"), vertexCount(ranges) * channels + 1);
  checkOffsets(json, offsets);
  const auto indices = readIndices(json.at("indices"), offsets);
  checkRows(json, target->faceSize, offsets, indices);
  const auto values =
      values_.floats(json.at("values"), "SCALAR", indices.size(), std::span(offsets).subspan(1));
  rows_.resize(input_.scene.vertexCount() * channels);
  const std::size_t base = pooledIndices_.size();
  std::size_t row = 0;
  for (const PrimitiveRange& range : ranges)
    for (std::size_t r = 0; r < range.vertexCount * channels; ++r, ++row)
      rows_[range.firstVertex * channels + r] = {base + offsets[row], offsets[row + 1] - offsets[row]};
  pooledIndices_.insert(pooledIndices_.end(), indices.begin(), indices.end());
  pooledValues_.insert(pooledValues_.end(), values.begin(), values.end());
}

void HaarRowsReader::finish(HaarTransfer& haar) const {
  haar.offsets = {0};
  for (const RowPlace& row : rows_) {
    const auto first = static_cast<std::ptrdiff_t>(row.first),
               last = static_cast<std::ptrdiff_t>(row.first + row.count);
    haar.indices.insert(haar.indices.end(), pooledIndices_.begin() + first, pooledIndices_.begin() + last);
    haar.values.insert(haar.values.end(), pooledValues_.begin() + first, pooledValues_.begin() + last);
    haar.offsets.push_back(static_cast<std::uint32_t>(haar.indices.size()));
  }
}

nlohmann::ordered_json haarToJson(const BakedOutput& output, std::string_view name, const HaarTransfer& haar,
                                  const PrimitiveRanges& ranges) {
  const auto channels = static_cast<std::size_t>(haar.channels);
  std::vector<std::uint32_t> offsets = {0};
  for (const PrimitiveRange& range : ranges) {
    const std::size_t first = range.firstVertex * channels, last = first + range.vertexCount * channels;
    const std::uint32_t base = offsets.back() - haar.offsets[first];  // may wrap, as the sums below do
    for (std::size_t row = first; row < last; ++row) offsets.push_back(base + haar.offsets[row + 1]);
  }
  Json json = {{"faceSize", haar.faceSize}, {"channels", haar.channels}, {"bounces", haar.bounces}};
  json["offsets"] = appendValues(output.document, offsets);
  if (output.quantizes()) {
    addQuantizedRows(output, name, haar, ranges, std::span(offsets).subspan(1), json);
    return json;
  }
  json["indices"] =
      appendIndices(output.document, gatherRows(haar.indices, haar, ranges), haar.storedIndexBytes());
  json["values"] = appendValues(output.document, gatherRows(haar.values, haar, ranges));
  return json;
}

void writeHaar(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (output.bake.haar) entry["haar"] = haarToJson(output, "Haar", *output.bake.haar, ranges);
}

std::unique_ptr<TechniqueReader> makeHaarReader(const BakedInput& input) {
  return makeTechniqueReader<HaarReader>(input);
}

}  // namespace prelight
