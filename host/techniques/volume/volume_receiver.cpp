#include "techniques/volume/volume_receiver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight {

namespace {

constexpr int leastOwnOrder = 3;  ///< light sent by surfaces and by lamps has at most as many bands
constexpr double fullSolidAngle = 4.0 * std::numbers::pi;

/// Returns the weighted sum over corners of rows of `width` values that begin at `first`, [i].
std::vector<double> mix(std::span<const VolumeCorner> corners, const std::vector<float>& values,
                        std::size_t stride, std::size_t first, std::size_t width) {
  std::vector<double> sum(width, 0.0);
  for (const VolumeCorner& corner : corners) {
    if (corner.weight == 0.0) continue;
    const float* row = values.data() + corner.voxel * stride + first;
    for (std::size_t i = 0; i < width; ++i) sum[i] += corner.weight * double(row[i]);
  }
  return sum;
}

/// Adds own[j] x values[channel][j][column] of cells to sum[column], for `bands` functions of direction.
void addByDirection(std::span<const VolumeCorner> corners, const std::vector<float>& values,
                    std::size_t channel, std::size_t bands, std::span<const float> own,
                    std::span<double> sum) {
  const std::size_t columns = sum.size(), length = bands * columns;
  const std::vector<double> mixed = mix(corners, values, 3 * length, channel * length, length);
  for (std::size_t j = 0; j < bands; ++j)
    for (std::size_t i = 0; i < columns; ++i) sum[i] += double(own[j]) * mixed[j * columns + i];
}

void store(std::span<const double> from, std::span<float> to) {
  std::transform(from.begin(), from.end(), to.begin(),
                 [](double value) { return static_cast<float>(value); });
}

}  // namespace

VolumeReceiver::VolumeReceiver(const VolumeTransfer& volume)
    : volume_(volume), product_(ownOrder(volume), volume.order) {}

int VolumeReceiver::ownOrder(const VolumeTransfer& volume) { return std::max(volume.order, leastOwnOrder); }

/// Adds light sent by surfaces. If its directions are not known, it is assumed to arrive uniformly from all
/// sides.
void VolumeReceiver::addSent(std::span<const VolumeCorner> corners, std::size_t channel,
                             std::span<const float> own, std::span<double> sum) const {
  if (!volume_.sent.empty())
    return addByDirection(corners, volume_.sent, channel, volume_.sentBands(), own, sum);
  if (volume_.channels == 1) return;
  const std::size_t n = volume_.columns();
  const std::vector<double> all = mix(corners, volume_.coefficients, 3 * n, channel * n, n);
  const std::vector<double> direct = mix(corners, volume_.direct, n, 0, n);
  for (std::size_t i = 0; i < n; ++i)
    sum[i] += std::sqrt(fullSolidAngle) * double(own[0]) * (all[i] - direct[i]);
}

void VolumeReceiver::receive(std::span<const VolumeCorner> corners, std::span<const float> own,
                             int ownChannels, double sentShare, const ReceivedTransfer& into) const {
  const std::size_t n = volume_.columns(), groups = volume_.groups();
  const auto ownColumns = static_cast<std::size_t>(product_.order() * product_.order());
  const std::vector<float>& direct = volume_.direct.empty() ? volume_.coefficients : volume_.direct;
  std::vector<double> visibility = mix(corners, direct, n, 0, n), matrix(ownColumns * ownColumns);
  for (double& v : visibility) v *= fullSolidAngle;
  product_.matrix(visibility, matrix);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::span<const float> mine = own.subspan(ownChannels == 3 ? c * ownColumns : 0, ownColumns);
    std::vector<double> sum(n, 0.0), lights(into.lights.empty() ? 0 : groups, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < ownColumns; ++k) sum[i] += matrix[i * ownColumns + k] * double(mine[k]);
    std::vector<double> sent(n, 0.0);
    addSent(corners, c, mine, sent);
    for (std::size_t i = 0; i < n; ++i) sum[i] += sentShare * sent[i];
    store(sum, into.sh.subspan(c * n, n));
    if (!lights.empty()) addByDirection(corners, volume_.lights, c, volume_.lightBands(), mine, lights);
    for (double& light : lights) light *= sentShare;
    if (!lights.empty()) store(lights, into.lights.subspan(c * groups, groups));
  }
}

}  // namespace prelight
