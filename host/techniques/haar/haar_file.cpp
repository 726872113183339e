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

/// The parts of a scene's sparse rows that belong to ranges, one after the other, in an accessor of numbers
/// of type T.
template <typename T, typename Stored>
int appendRows(GltfDocument& document, const std::vector<Stored>& values, const HaarTransfer& haar,
               const PrimitiveRanges& ranges) {
  const auto channels = static_cast<std::size_t>(haar.channels);
  std::vector<T> gathered;
  for (const PrimitiveRange& range : ranges) {
    const std::uint32_t first = haar.offsets[range.firstVertex * channels],
                        last = haar.offsets[(range.firstVertex + range.vertexCount) * channels];
    const auto rows = std::span(values).subspan(first, last - first);
    if constexpr (std::is_same_v<T, Stored>)
      if (ranges.size() == 1 && !rows.empty()) return appendValues(document, rows);
    gathered.insert(gathered.end(), rows.begin(), rows.end());
  }
  // glTF has no accessor of 0 elements: rows that are all empty point at nothing.
  if (gathered.empty()) gathered.push_back(0);
  return appendValues(document, gathered);
}

void checkRows(const JsonCursor& json, int faceSize, const std::vector<std::uint32_t>& offsets,
               const std::vector<std::uint32_t>& indices) {
  if (offsets.front() != 0 || offsets.back() > indices.size() ||
      !std::is_sorted(offsets.begin(), offsets.end()))
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

void HaarRowsReader::read(const JsonCursor& json, const PrimitiveRanges& ranges,
                          std::optional<HaarTransfer>& target) {
  readHeader(json, target);
  const auto channels = static_cast<std::size_t>(target->channels);
  const auto offsets =
      values_.integers<std::uint32_t>(json.at("offsets"), vertexCount(ranges) * channels + 1);
  const auto indices = values_.shortOrLongIntegers(json.at("indices"));
  const auto values = values_.floats(json.at("values"), "SCALAR", indices.size());
  checkRows(json, target->faceSize, offsets, indices);
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

nlohmann::ordered_json haarToJson(GltfDocument& document, const HaarTransfer& haar,
                                  const PrimitiveRanges& ranges) {
  const auto channels = static_cast<std::size_t>(haar.channels);
  std::vector<std::uint32_t> offsets = {0};
  for (const PrimitiveRange& range : ranges) {
    const std::size_t first = range.firstVertex * channels, last = first + range.vertexCount * channels;
    const std::uint32_t base = offsets.back() - haar.offsets[first];  // may wrap, as the sums below do
    for (std::size_t row = first; row < last; ++row) offsets.push_back(base + haar.offsets[row + 1]);
  }
  Json json = {{"faceSize", haar.faceSize}, {"channels", haar.channels}, {"bounces", haar.bounces}};
  json["offsets"] = appendValues(document, offsets);
  json["indices"] = haar.storedIndexBytes() == sizeof(std::uint16_t)
                        ? appendRows<std::uint16_t>(document, haar.indices, haar, ranges)
                        : appendRows<std::uint32_t>(document, haar.indices, haar, ranges);
  json["values"] = appendRows<float>(document, haar.values, haar, ranges);
  return json;
}

void writeHaar(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (output.bake.haar) entry["haar"] = haarToJson(output.document, *output.bake.haar, ranges);
}

std::unique_ptr<TechniqueReader> makeHaarReader(const BakedInput& input) {
  return makeTechniqueReader<HaarReader>(input);
}

}  // namespace prelight
