#include "compress/compressed_parts.h"

#include <algorithm>
#include <cmath>

#include "compress/compress.h"

namespace prelight {

namespace {

double relativeError(const std::vector<float>& original, const std::vector<float>& restored) {
  double squares = 0.0, all = 0.0;
  for (std::size_t i = 0; i < original.size(); ++i) {
    const double difference = double(restored[i]) - double(original[i]);
    squares += difference * difference;
    all += double(original[i]) * double(original[i]);
  }
  return all > 0.0 ? std::sqrt(squares / all) : 0.0;
}

class PartCompressor {
 public:
  PartCompressor(const CompressionRequest& request, const Progress& progress)
      : request_(request), progress_(progress) {}

  /// Compresses a part and returns the decoded transfer.
  HarmonicTransfer compress(std::string_view part, const HarmonicTransfer& full,
                            std::span<const double> weights, std::optional<CompressedTransfer>& compressed) {
    CompressionRequest request = request_;
    request.components = std::min(request.components, full.channels * full.order * full.order);
    compressed = prelight::compress(full, request, weights, progress_);
    const std::size_t floatBytes = full.coefficients.size() * sizeof(float);
    if (compressed->byteCount() >= floatBytes) {
      compressed.reset();
      done_.push_back({part, floatBytes, floatBytes, 0.0});
      return full;
    }
    HarmonicTransfer restored = decompress(*compressed);
    done_.push_back(
        {part, floatBytes, compressed->byteCount(), relativeError(full.coefficients, restored.coefficients)});
    return restored;
  }

  std::vector<PartCompression> done() && { return std::move(done_); }

 private:
  const CompressionRequest& request_;
  const Progress& progress_;
  std::vector<PartCompression> done_;
};

void compressKeys(PartCompressor& compressor, std::span<const double> surface, AnimatedTransfer& animation,
                  std::optional<CompressedTransfer>& compressed) {
  HarmonicTransfer all{animation.keys[0].order, animation.keys[0].channels, animation.keys[0].bounces, {}};
  std::vector<double> weights;
  for (const HarmonicTransfer& key : animation.keys) {
    all.coefficients.insert(all.coefficients.end(), key.coefficients.begin(), key.coefficients.end());
    weights.insert(weights.end(), surface.begin(), surface.end());
  }
  takeKeys(compressor.compress("keys", all, weights, compressed), animation);
}

void compressTexels(PartCompressor& compressor, ChartTransfer& charts,
                    std::optional<CompressedTransfer>& compressed) {
  HarmonicTransfer all{charts.order, charts.channels, charts.bounces, {}};
  for (const ChartTransfer::Map& map : charts.maps)
    all.coefficients.insert(all.coefficients.end(), map.coefficients.begin(), map.coefficients.end());
  const HarmonicTransfer restored = compressor.compress("texels", all, {}, compressed);
  auto from = restored.coefficients.begin();
  for (ChartTransfer::Map& map : charts.maps) {
    std::copy_n(from, map.coefficients.size(), map.coefficients.begin());
    from += static_cast<std::ptrdiff_t>(map.coefficients.size());
  }
}

void compressVolume(PartCompressor& compressor, VolumeTransfer& volume, CompressedParts& parts) {
  const auto compress = [&](std::string_view part, int channels, std::vector<float>& values,
                            std::optional<CompressedTransfer>& compressed) {
    if (values.empty()) return;
    const HarmonicTransfer full{volume.order, channels, volume.bounces, std::move(values)};
    values = compressor.compress(part, full, {}, compressed).coefficients;
  };
  compress("volume", volume.channels, volume.coefficients, parts.volume);
  compress("volume before bounces", 1, volume.direct, parts.volumeDirect);
  compress("volume by direction", 3 * volume.sentOrder * volume.sentOrder, volume.sent, parts.volumeSent);
}

}  // namespace

std::vector<PartCompression> compressParts(const CompressionRequest& request, std::span<const double> surface,
                                           Bake& bake, const Progress& progress) {
  PartCompressor compressor(request, progress);
  if (bake.animation && !bake.animation->keys.empty())
    compressKeys(compressor, surface, *bake.animation, bake.compressedParts.keys);
  if (bake.chartTransfer) compressTexels(compressor, *bake.chartTransfer, bake.compressedParts.texels);
  if (bake.volume) compressVolume(compressor, *bake.volume, bake.compressedParts);
  return std::move(compressor).done();
}

void takeKeys(const HarmonicTransfer& all, AnimatedTransfer& animation) {
  const std::size_t each = all.coefficients.size() / animation.times.size();
  animation.keys.assign(animation.times.size(), {all.order, all.channels, all.bounces, {}});
  for (std::size_t k = 0; k < animation.keys.size(); ++k) {
    const auto from = all.coefficients.begin() + static_cast<std::ptrdiff_t>(k * each);
    animation.keys[k].coefficients.assign(from, from + static_cast<std::ptrdiff_t>(each));
  }
}

}  // namespace prelight
