#include "techniques/haar/haar_relighter.h"

#include <fmt/format.h>

#include <algorithm>

#include "prelight/error.h"

namespace prelight {

namespace {

constexpr std::size_t blockVertexCount = 1024;
constexpr std::size_t rowGroupSize = 64;

}  // namespace

HaarRelighter::HaarRelighter(DeviceContext& device, const HaarTransfer& transfer, HaarForm form)
    : device_(device),
      form_(form),
      texels_(6 * static_cast<std::size_t>(transfer.faceSize) * static_cast<std::size_t>(transfer.faceSize)),
      channels_(static_cast<std::size_t>(transfer.channels)),
      vertices_(transfer.offsets.empty() ? 0 : (transfer.offsets.size() - 1) / channels_) {
  const BuildOptions options = BuildOptions()
                                   .define("PRELIGHT_CHANNELS", transfer.channels)
                                   .define("PRELIGHT_BLOCK", static_cast<int>(blockVertexCount))
                                   .define("PRELIGHT_COLUMN_COUNT", static_cast<int>(texels_));
  if (form == HaarForm::Rows) {
    rowsKernel_ = {device, "techniques/haar/haar_kernels.cl", options, "relightHaarRows"};
    uploadRows(transfer);
  } else {
    columnsKernel_ = {device, "techniques/haar/haar_kernels.cl", options, "relightHaarColumns"};
    uploadColumns(transfer);
  }
}

void HaarRelighter::uploadRows(const HaarTransfer& transfer) {
  offsets_ = Buffer<std::uint32_t>(device_, std::span<const std::uint32_t>(transfer.offsets));
  indices_ = Buffer<std::uint32_t>(device_, std::span<const std::uint32_t>(transfer.indices));
  values_ = Buffer<float>(device_, std::span<const float>(transfer.values));
  light_ = Buffer<float>(device_, 4 * texels_);
}

/// Sorts every block's entries by channel and coefficient (counting sort), and within a column by vertex.
void HaarRelighter::uploadColumns(const HaarTransfer& transfer) {
  const std::size_t blocks = (vertices_ + blockVertexCount - 1) / blockVertexCount;
  const std::size_t columns = channels_ * texels_;
  columnOffsets_.assign(blocks * columns + 1, 0);
  const auto columnOf = [&](std::size_t row, std::uint32_t index) {
    return row / channels_ / blockVertexCount * columns + row % channels_ * texels_ + index;
  };
  const std::size_t rows = vertices_ * channels_;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::uint32_t at = transfer.offsets[row]; at < transfer.offsets[row + 1]; ++at)
      ++columnOffsets_[columnOf(row, transfer.indices[at]) + 1];
  for (std::size_t i = 1; i < columnOffsets_.size(); ++i) columnOffsets_[i] += columnOffsets_[i - 1];
  std::vector<std::uint32_t> next(columnOffsets_.begin(), columnOffsets_.end() - 1);
  std::vector<std::uint16_t> vertices(transfer.indices.size());
  std::vector<float> values(transfer.indices.size());
  for (std::size_t row = 0; row < rows; ++row)
    for (std::uint32_t at = transfer.offsets[row]; at < transfer.offsets[row + 1]; ++at) {
      const std::uint32_t to = next[columnOf(row, transfer.indices[at])]++;
      vertices[to] = static_cast<std::uint16_t>(row / channels_ % blockVertexCount);
      values[to] = transfer.values[at];
    }
  offsets_ = Buffer<std::uint32_t>(device_, std::span<const std::uint32_t>(columnOffsets_));
  blockVertices_ = Buffer<std::uint16_t>(device_, std::span<const std::uint16_t>(vertices));
  values_ = Buffer<float>(device_, std::span<const float>(values));
}

void HaarRelighter::setLight(std::span<const haar::LitWavelet> light) {
  std::vector<haar::LitWavelet> sorted(light.begin(), light.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const haar::LitWavelet& a, const haar::LitWavelet& b) { return a.index < b.index; });
  if (!sorted.empty() && sorted.back().index >= texels_)
    throw UsageError("light",
                     fmt::format("got coefficient {}, expected one below {}", sorted.back().index, texels_));
  litCount_ = sorted.size();
  bytesMoved_ = vertices_ * 3 * sizeof(float);
  if (form_ == HaarForm::Rows) {
    std::vector<float> table(4 * texels_, 0.0f);
    for (const haar::LitWavelet& lit : sorted)
      for (std::size_t c = 0; c < 3; ++c) table[4 * lit.index + c] += lit.color[static_cast<int>(c)];
    light_.write(std::span<const float>(table));
    bytesMoved_ += offsets_.bytes() + indices_.bytes() + values_.bytes();
    return;
  }
  std::vector<std::uint32_t> indices;
  std::vector<float> colors;
  for (const haar::LitWavelet& lit : sorted) {
    indices.push_back(lit.index);
    colors.insert(colors.end(), {lit.color.x, lit.color.y, lit.color.z, 0.0f});
  }
  lit_ = Buffer<std::uint32_t>(device_, std::span<const std::uint32_t>(indices));
  light_ = Buffer<float>(device_, std::span<const float>(colors));
  for (std::size_t first = 0; first + 1 < columnOffsets_.size(); first += texels_)
    for (const std::uint32_t index : indices)
      bytesMoved_ +=
          2 * sizeof(std::uint32_t) + (columnOffsets_[first + index + 1] - columnOffsets_[first + index]) *
                                          (sizeof(std::uint16_t) + sizeof(float));
}

void HaarRelighter::relight(Buffer<float>& radiance) {
  const auto vertices = static_cast<std::uint32_t>(vertices_);
  if (form_ == HaarForm::Rows) {
    rowsKernel_.launch({vertices_, rowGroupSize}, offsets_, indices_, values_, light_, vertices, radiance);
    return;
  }
  if (litCount_ == 0) {
    radiance.fill(0.0f);
    return;
  }
  // A work-group processes a block; on a CPU it has one item, which is a core.
  const std::size_t items = device_.info().kind == DeviceKind::Cpu ? 1 : 64;
  columnsKernel_.launch({(vertices_ + blockVertexCount - 1) / blockVertexCount * items, items}, offsets_,
                        blockVertices_, values_, lit_, light_, static_cast<std::uint32_t>(litCount_),
                        vertices, radiance);
}

}  // namespace prelight
