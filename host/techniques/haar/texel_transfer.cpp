#include "techniques/haar/texel_transfer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/spans.h"

namespace prelight {

namespace {

/// Rays that a square needs, effectively, for a fraction of its own.
constexpr float leastRays = 2.0f;

/// Receivers a slot that are looked at on triangles which do not touch it, where their weights are small; and
/// how many one of them stands for at most.
constexpr std::size_t farReceivers = 16;
constexpr std::size_t largestFarStep = 4;

/// Rows of rays that are asked for before they are needed.
constexpr std::size_t rowsAhead = 3;

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

/// Squares of the next finer level that make up a square, of 2^bits a side here.
std::array<std::size_t, 4> quartersOf(std::size_t square, int bits) {
  const std::size_t size = std::size_t{1} << bits;
  const std::size_t first = 4 * (square >> bits) * size + 2 * (square & (size - 1));
  return {first, first + 1, first + 2 * size, first + 2 * size + 1};
}

/// Sums of four neighbours: from faces of 2 size x 2 size to faces of size x size.
template <typename T, typename Add>
void halve(const T* fine, std::size_t size, T* coarse, const Add& add) {
  for (std::size_t row = 0; row < cubeFaces * size; ++row, fine += 4 * size, coarse += size)
    for (std::size_t column = 0; column < size; ++column) {
      const T *upper = fine + 2 * column, *lower = upper + 2 * size;
      coarse[column] = add(upper[0], upper[1], lower[0], lower[1]);
    }
}

}  // namespace

TexelTransfer::TexelTransfer(const CompiledScene& scene, const FitMesh& mesh, const SideSums& side,
                             const TexelColumn& column)
    : scene_(scene),
      mesh_(mesh),
      texelRows_(column.rowsOn(side)),
      texels_(column.faceSize()),
      faceSize_(column.faceSize()),
      levels_(std::bit_width(static_cast<unsigned>(faceSize_))),
      levelStart_{0},
      equations_(side.fit().equations(defaultSmoothing)) {
  const std::size_t receivers = side.records().size() / std::max(1u, mesh.slotCount());
  farStep_ = static_cast<std::uint32_t>(std::clamp<std::size_t>(receivers / farReceivers, 1, largestFarStep));
  for (int level = 0; level < levels_; ++level)
    levelStart_.push_back(levelStart_.back() + cubeTexelCount(faceSize_ >> level));
  std::vector<std::uint32_t> triangles;
  std::vector<SampleRecord> records(side.records().size());
  side.records().read(0, records);
  for (const SampleRecord& record : records) triangles.push_back(record.sample.triangle);
  std::vector<std::uint32_t> order;
  bucket(triangles, mesh.triangles.size(), receiverStart_, order);
  for (const std::uint32_t record : order) {
    const SurfaceSample& sample = records[record].sample;
    const double weight = side.fit().weightOf(sample);
    const auto b = cornerWeights(sample);
    receivers_.push_back({{static_cast<float>(weight * b[0]), static_cast<float>(weight * b[1]),
                           static_cast<float>(weight * b[2])},
                          texelRows_.rowOf(record)});
  }
  std::vector<std::uint32_t> corners;
  for (const auto& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  bucket(corners, mesh.slotCount(), triangleStart_, slotTriangles_);
  for (std::uint32_t& corner : slotTriangles_) corner /= 3;
}

TexelTransfer::Workspace TexelTransfer::workspace() const {
  const std::vector<RaySums> sums(levelStart_.back());
  return {{sums, sums}, std::vector<float>(levelStart_.back()), {}};
}

bool TexelTransfer::evaluate(std::uint32_t slot, Workspace& work, std::span<float> texels) const {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(scene_.normals[mesh_.vertexOfSlot[slot]]));
  texels_.open(normal, std::span(work.open).first(texels_.count()));
  for (std::vector<RaySums>& sums : work.sums) std::fill_n(sums.begin(), texels_.count(), RaySums{});
  PlainWeights plain;
  if (!weighReceivers(slot, work, plain)) {
    std::copy_n(work.open.begin(), texels_.count(), texels.begin());
    return false;
  }
  addRays(work);
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

// Lists the receivers around a slot that have rows, and sums up the others.
bool TexelTransfer::weighReceivers(std::uint32_t slot, Workspace& work, PlainWeights& plain) const {
  work.rows.clear();
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
    const std::uint32_t begin = receiverStart_[t];
    for (std::uint32_t r = begin + (slot + step - begin % step) % step; r < receiverStart_[t + 1];
         r += step) {
      const auto& [w, texelRow] = receivers_[r];
      const double weight = step * (w[0] * corner[0] + w[1] * corner[1] + w[2] * corner[2]);
      if (texelRow == TexelRows::open) plain.open += weight;
      if (texelRow == TexelRows::closed) plain.closed += weight;
      if (texelRow < TexelRows::missing) work.rows.push_back({texelRow, static_cast<float>(weight)});
    }
  }
  return true;
}

void TexelTransfer::addRays(Workspace& work) const {
  for (std::size_t i = 0; i < work.rows.size(); ++i) {
    // Rows lie anywhere in memory, and their rays would be waited for.
    if (i + rowsAhead < work.rows.size()) {
      const auto soon = texelRows_.codes(work.rows[i + rowsAhead].row);
      prefetch(soon.data(), soon.size());
    }
    const auto codes = texelRows_.codes(work.rows[i].row);
    addRow(codes, work.rows[i].weight / static_cast<float>(codes.size()), work);
  }
}

void TexelTransfer::addRow(std::span<const std::uint32_t> codes, float share, Workspace& work) {
  const float square = share * share;
  const auto add = [](RaySums& sums, float rayShare, float raySquare) {
    sums.weight += rayShare;
    sums.square += raySquare;
  };
  const std::array<RaySums*, 2> sums = {work.sums[0].data(), work.sums[1].data()};
  for (const std::uint32_t code : codes) {
    const std::uint32_t texel = code >> 8, blocked = code & 255u;
    // 0 or 255, in one test: which of them it is cannot be foreseen.
    if (((blocked + 1u) & 0xfeu) == 0) {
      add(sums[blocked & 1u][texel], share, square);
    } else {
      const float fraction = static_cast<float>(blocked) / 255.0f;
      add(sums[0][texel], share * (1.0f - fraction), square * (1.0f - fraction));
      add(sums[1][texel], share * fraction, square * fraction);
    }
  }
}

void TexelTransfer::buildPyramid(Workspace& work) const {
  for (int level = 1; level < levels_; ++level) {
    const auto size = static_cast<std::size_t>(faceSize_ >> level);
    for (std::vector<RaySums>& sums : work.sums)
      halve(&sums[levelStart_[level - 1]], size, &sums[levelStart_[level]], [](const auto&... quarters) {
        return RaySums{(quarters.weight + ...), (quarters.square + ...)};
      });
    halve(&work.open[levelStart_[level - 1]], size, &work.open[levelStart_[level]],
          [](auto... quarters) { return (quarters + ...); });
  }
}

float TexelTransfer::wholeFraction(const PlainWeights& plain, const Workspace& work) const {
  double weight = plain.open + plain.closed, blocked = plain.closed;
  for (std::size_t face = 0; face < cubeFaces; ++face) {
    const std::size_t at = levelStart_[levels_ - 1] + face;
    weight += work.sums[0][at].weight + work.sums[1][at].weight;
    blocked += work.sums[1][at].weight;
  }
  return weight > 0.0 ? static_cast<float>(std::clamp(blocked / weight, 0.0, 1.0)) : 0.0f;
}

// Sets the blocked fraction of a square, if its rays tell one; true when they met both the open and a
// surface, so that its quarters may differ.
bool TexelTransfer::mixed(int level, std::size_t square, const PlainWeights& plain, const Workspace& work,
                          float& fraction) const {
  const std::size_t at = levelStart_[level] + square;
  const float open = work.open[at];
  if (open <= 0.0f) return false;
  const RaySums &escaped = work.sums[0][at], &hit = work.sums[1][at];
  // Receivers without a row have their rays where the closed form has its light.
  const float openWeight = static_cast<float>(plain.open) * open,
              closedWeight = static_cast<float>(plain.closed) * open;
  const bool shut = hit.square > 0.0f || closedWeight != 0.0f,
             clear = escaped.square > 0.0f || openWeight != 0.0f;
  if (!shut && !clear) return false;
  if (!shut || !clear) {
    fraction = shut ? 1.0f : 0.0f;
    return false;
  }
  const float weight = escaped.weight + hit.weight + openWeight + closedWeight;
  if (weight * weight < leastRays * (escaped.square + hit.square) || weight <= 0.0f) return false;
  fraction = std::clamp((hit.weight + closedWeight) / weight, 0.0f, 1.0f);
  return true;
}

void TexelTransfer::descend(int level, std::size_t square, float fraction, const PlainWeights& plain,
                            Workspace& work, std::span<float> texels) const {
  if (level == 0) return settle(level, square, fraction, work, texels);
  const auto children = quartersOf(square, levels_ - 1 - level);
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
  if (level == 0) {
    texels[square] = work.open[square] * (1.0f - fraction);
    return;
  }
  const int bits = levels_ - 1 - level;
  const std::size_t width = std::size_t{1} << level,
                    column0 = (square & ((std::size_t{1} << bits) - 1)) * width;
  const std::size_t first = (square >> bits) * width * static_cast<std::size_t>(faceSize_) + column0;
  for (std::size_t row = 0; row < width; ++row)
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t at = first + row * static_cast<std::size_t>(faceSize_) + column;
      texels[at] = work.open[at] * (1.0f - fraction);
    }
}

}  // namespace prelight
