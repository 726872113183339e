#include "bake/texel_transfer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace prelight {

namespace {

/// Rays that a square needs, effectively, for a fraction of its own.
constexpr float leastRays = 2.0f;

/// Receivers a slot that are looked at on triangles which do not touch it, where their weights are small; and
/// how many one of them stands for at most.
constexpr std::size_t farReceivers = 16;
constexpr std::size_t largestFarStep = 4;

/// Indices of items in the order of their keys, and where each key's begin: [key + 1].
void bucket(const std::vector<std::uint32_t>& keys, std::size_t keyCount, std::vector<std::uint32_t>& start,
            std::vector<std::uint32_t>& order) {
  start.assign(keyCount + 1, 0);
  for (const std::uint32_t key : keys) ++start[key + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  order.resize(keys.size());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t i = 0; i < keys.size(); ++i) order[next[keys[i]]++] = i;
}

/// Squares of the next finer level, of `size` squares a side here, that make up a square.
std::array<std::size_t, 4> quartersOf(std::size_t square, std::size_t size) {
  const std::size_t first = 4 * (square / size) * size + 2 * (square % size);
  return {first, first + 1, first + 2 * size, first + 2 * size + 1};
}

}  // namespace

TexelTransfer::TexelTransfer(const CompiledScene& scene, const FitMesh& mesh, const SideCast& side,
                             int faceSize)
    : scene_(scene),
      mesh_(mesh),
      side_(side),
      texels_(faceSize),
      faceSize_(faceSize),
      levels_(std::bit_width(static_cast<unsigned>(faceSize))),
      levelStart_{0},
      equations_(side.fit().equations(defaultSmoothing)) {
  const std::size_t receivers = side.records().size() / std::max(1u, mesh.slotCount());
  farStep_ = static_cast<std::uint32_t>(std::clamp<std::size_t>(receivers / farReceivers, 1, largestFarStep));
  for (int level = 0; level < levels_; ++level)
    levelStart_.push_back(levelStart_.back() + cubeTexelCount(faceSize >> level));
  std::vector<std::uint32_t> triangles;
  for (const SampleRecord& record : side.records()) triangles.push_back(record.sample.triangle);
  bucket(triangles, mesh.triangles.size(), recordStart_, recordOrder_);
  std::vector<std::uint32_t> corners;
  for (const auto& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  bucket(corners, mesh.slotCount(), triangleStart_, slotTriangles_);
  for (std::uint32_t& corner : slotTriangles_) corner /= 3;
}

TexelTransfer::Workspace TexelTransfer::workspace() const {
  return {std::vector<TexelSums>(levelStart_.back()), std::vector<float>(levelStart_.back())};
}

bool TexelTransfer::evaluate(std::uint32_t slot, Workspace& work, std::span<float> texels) const {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(scene_.normals[mesh_.vertexOfSlot[slot]]));
  texels_.open(normal, std::span(work.open).first(texels_.count()));
  std::fill_n(work.sums.begin(), texels_.count(), TexelSums{});
  PlainWeights plain;
  if (!addRays(slot, work, plain)) {
    std::copy_n(work.open.begin(), texels_.count(), texels.begin());
    return false;
  }
  buildPyramid(work);
  const int top = levels_ - 1;
  const float whole = wholeFraction(plain, work);
  for (std::size_t face = 0; face < cubeFaces; ++face) {
    float fraction = whole;
    if (mixed(top, face, plain, work, fraction))
      descend(top, face, fraction, plain, work, texels);
    else
      settle(top, face, fraction, work, texels);
  }
  return true;
}

bool TexelTransfer::addRays(std::uint32_t slot, Workspace& work, PlainWeights& plain) const {
  const std::vector<SlotWeight> row = equations_.inverseRow(slot);
  if (row.empty()) return false;
  const auto weightOf = [&](std::uint32_t s) {
    const auto at = std::lower_bound(row.begin(), row.end(), s,
                                     [](const SlotWeight& w, std::uint32_t value) { return w.slot < value; });
    return at != row.end() && at->slot == s ? at->weight : 0.0;
  };
  std::vector<std::uint32_t> triangles;
  for (const SlotWeight& w : row)
    triangles.insert(triangles.end(), slotTriangles_.begin() + triangleStart_[w.slot],
                     slotTriangles_.begin() + triangleStart_[w.slot + 1]);
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  for (const std::uint32_t t : triangles) {
    std::array<double, 3> corner{};
    for (std::size_t k = 0; k < 3; ++k) corner[k] = weightOf(mesh_.triangles[t][k]);
    // Weights away from the slot are small: one receiver in so many stands for the others there.
    const auto& corners = mesh_.triangles[t];
    const bool near = std::find(corners.begin(), corners.end(), slot) != corners.end();
    const std::uint32_t step = near ? 1 : farStep_;
    const std::uint32_t first = recordStart_[t] + (slot + step - recordStart_[t] % step) % step;
    for (std::uint32_t r = first; r < recordStart_[t + 1]; r += step) {
      const SurfaceSample& sample = side_.records()[recordOrder_[r]].sample;
      const auto b = cornerWeights(sample);
      const double share = b[0] * corner[0] + b[1] * corner[1] + b[2] * corner[2];
      addReceiver(recordOrder_[r], step * side_.fit().weightOf(sample) * share, work, plain);
    }
  }
  return true;
}

void TexelTransfer::addReceiver(std::size_t record, double weight, Workspace& work,
                                PlainWeights& plain) const {
  const std::uint32_t row = side_.texelRows().rowOf(record);
  if (row == TexelRows::missing) return;
  if (row == TexelRows::open || row == TexelRows::closed) {
    (row == TexelRows::open ? plain.open : plain.closed) += weight;
    return;
  }
  const auto codes = side_.texelRows().codes(row);
  const float share = static_cast<float>(weight / static_cast<double>(codes.size()));
  const float magnitude = std::abs(share), square = share * share;
  for (const std::uint32_t code : codes) {
    TexelSums& sums = work.sums[code >> 8];
    const std::uint32_t blocked = code & 255u;
    sums.weight += share;
    sums.square += square;
    if (blocked > 0) {
      sums.blocked += share * static_cast<float>(blocked) / 255.0f;
      sums.shut += magnitude;
    }
    if (blocked < 255) sums.clear += magnitude;
  }
}

void TexelTransfer::buildPyramid(Workspace& work) const {
  for (int level = 1; level < levels_; ++level) {
    const auto size = static_cast<std::size_t>(faceSize_ >> level);
    const TexelSums* fine = &work.sums[levelStart_[level - 1]];
    const float* fineOpen = &work.open[levelStart_[level - 1]];
    TexelSums* coarse = &work.sums[levelStart_[level]];
    float* coarseOpen = &work.open[levelStart_[level]];
    for (std::size_t square = 0; square < cubeFaces * size * size; ++square) {
      TexelSums sum;
      float open = 0.0f;
      for (const std::size_t at : quartersOf(square, size)) {
        sum.weight += fine[at].weight;
        sum.blocked += fine[at].blocked;
        sum.shut += fine[at].shut;
        sum.clear += fine[at].clear;
        sum.square += fine[at].square;
        open += fineOpen[at];
      }
      coarse[square] = sum;
      coarseOpen[square] = open;
    }
  }
}

float TexelTransfer::wholeFraction(const PlainWeights& plain, const Workspace& work) const {
  double weight = plain.open + plain.closed, blocked = plain.closed;
  for (std::size_t face = 0; face < cubeFaces; ++face) {
    weight += work.sums[levelStart_[levels_ - 1] + face].weight;
    blocked += work.sums[levelStart_[levels_ - 1] + face].blocked;
  }
  return weight > 0.0 ? static_cast<float>(std::clamp(blocked / weight, 0.0, 1.0)) : 0.0f;
}

// Sets the blocked fraction of a square, if its rays tell one; true when they met both the open and a
// surface, so that its quarters may differ.
bool TexelTransfer::mixed(int level, std::size_t square, const PlainWeights& plain, const Workspace& work,
                          float& fraction) const {
  const std::size_t at = levelStart_[level] + square;
  const TexelSums& sums = work.sums[at];
  const float open = work.open[at];
  if (open <= 0.0f) return false;
  // Receivers without a row have their rays where the closed form has its light.
  const float openWeight = static_cast<float>(plain.open) * open,
              closedWeight = static_cast<float>(plain.closed) * open;
  const float shut = sums.shut + std::abs(closedWeight), clear = sums.clear + std::abs(openWeight);
  if (shut == 0.0f && clear == 0.0f) return false;
  if (shut == 0.0f || clear == 0.0f) {
    fraction = shut == 0.0f ? 0.0f : 1.0f;
    return false;
  }
  const float weight = sums.weight + openWeight + closedWeight;
  if (weight * weight < leastRays * sums.square || weight <= 0.0f) return false;
  fraction = std::clamp((sums.blocked + closedWeight) / weight, 0.0f, 1.0f);
  return true;
}

void TexelTransfer::descend(int level, std::size_t square, float fraction, const PlainWeights& plain,
                            Workspace& work, std::span<float> texels) const {
  if (level == 0) return settle(level, square, fraction, work, texels);
  const auto children = quartersOf(square, static_cast<std::size_t>(faceSize_ >> level));
  std::array<float, 4> fractions{};
  std::array<bool, 4> isMixed{};
  float missing = work.open[levelStart_[level] + square] * fraction, room = 0.0f;
  for (std::size_t k = 0; k < 4; ++k) {
    fractions[k] = fraction;
    isMixed[k] = mixed(level - 1, children[k], plain, work, fractions[k]);
    const float open = work.open[levelStart_[level - 1] + children[k]];
    missing -= open * fractions[k];
    // What the parent has and the children lack or exceed goes to those that are not settled.
    if (fractions[k] > 0.0f && fractions[k] < 1.0f) room += open;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (room > 0.0f && fractions[k] > 0.0f && fractions[k] < 1.0f)
      fractions[k] = std::clamp(fractions[k] + missing / room, 0.0f, 1.0f);
    if (isMixed[k])
      descend(level - 1, children[k], fractions[k], plain, work, texels);
    else
      settle(level - 1, children[k], fractions[k], work, texels);
  }
}

void TexelTransfer::settle(int level, std::size_t square, float fraction, const Workspace& work,
                           std::span<float> texels) const {
  const auto size = static_cast<std::size_t>(faceSize_ >> level), width = static_cast<std::size_t>(1)
                                                                          << level;
  const std::size_t first =
      (square / size * width) * static_cast<std::size_t>(faceSize_) + square % size * width;
  for (std::size_t row = 0; row < width; ++row)
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t at = first + row * static_cast<std::size_t>(faceSize_) + column;
      texels[at] = work.open[at] * (1.0f - fraction);
    }
}

}  // namespace prelight
