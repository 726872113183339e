#include "techniques/haar/haar_relight.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "basis/haar.h"
#include "basis/sh.h"

namespace prelight::haar {
namespace {

std::size_t coefficientCount(const HaarTransfer& transfer) { return cubeTexelCount(transfer.faceSize); }

std::size_t rowCount(const HaarTransfer& transfer) { return transfer.offsets.size() - 1; }

/// Adds a row times a factor to dense coefficients.
void addRow(const HaarTransfer& transfer, std::size_t row, double factor, std::span<double> sum) {
  for (std::uint32_t k = transfer.offsets[row]; k < transfer.offsets[row + 1]; ++k) {
    sum[transfer.indices[k]] += factor * static_cast<double>(transfer.values[k]);
  }
}

SparseRow keepDense(std::span<const double> sum, double relativeError, std::vector<float>& scratch) {
  scratch.assign(sum.begin(), sum.end());
  return keepError(scratch, relativeError);
}

/// Returns the row of a vertex's channel; transfers of one channel have one row for all.
std::size_t rowOf(const HaarTransfer& transfer, std::size_t vertex, int channel) {
  return vertex * static_cast<std::size_t>(transfer.channels) +
         static_cast<std::size_t>(transfer.channels == 1 ? 0 : channel);
}

}  // namespace

std::vector<float> coefficientRms(const HaarTransfer& transfer) {
  std::vector<double> squares(coefficientCount(transfer), 0.0);
  for (std::size_t k = 0; k < transfer.indices.size(); ++k) {
    squares[transfer.indices[k]] += double(transfer.values[k]) * double(transfer.values[k]);
  }
  std::vector<float> rms(squares.size());
  const double rows = static_cast<double>(std::max<std::size_t>(rowCount(transfer), 1));
  for (std::size_t i = 0; i < rms.size(); ++i) rms[i] = static_cast<float>(std::sqrt(squares[i] / rows));
  return rms;
}

std::vector<glm::dvec3> relight(const HaarTransfer& transfer, std::span<const float> light) {
  const std::size_t count = coefficientCount(transfer);
  assert(light.size() == 3 * count);
  const std::size_t vertices = rowCount(transfer) / static_cast<std::size_t>(transfer.channels);
  std::vector<glm::dvec3> result(vertices, glm::dvec3(0.0));
  for (std::size_t v = 0; v < vertices; ++v) {
    for (int c = 0; c < 3; ++c) {
      const std::size_t row = rowOf(transfer, v, c);
      for (std::uint32_t k = transfer.offsets[row]; k < transfer.offsets[row + 1]; ++k) {
        const float value = light[static_cast<std::size_t>(c) * count + transfer.indices[k]];
        result[v][c] += static_cast<double>(transfer.values[k]) * static_cast<double>(value);
      }
    }
  }
  return result;
}

std::vector<glm::dvec3> relight(const HaarTransfer& transfer, const SparseLight& light) {
  const std::size_t count = coefficientCount(transfer);
  std::vector<float> dense(3 * count, 0.0f);
  for (std::size_t k = 0; k < light.indices.size(); ++k) {
    for (int c = 0; c < 3; ++c)
      dense[static_cast<std::size_t>(c) * count + light.indices[k]] = light.values[k][c];
  }
  return relight(transfer, dense);
}

glm::dvec3 relightVertex(const HaarTransfer& transfer, std::size_t vertex, const SparseRow& light) {
  glm::dvec3 sum(0.0);
  for (int c = 0; c < transfer.channels; ++c) {
    const std::size_t row = rowOf(transfer, vertex, c);
    const auto begin = transfer.indices.begin() + transfer.offsets[row];
    const auto end = transfer.indices.begin() + transfer.offsets[row + 1];
    auto at = begin;  // both are ascending
    for (std::size_t k = 0; k < light.indices.size(); ++k) {
      at = std::lower_bound(at, end, light.indices[k]);
      if (at == end) break;
      if (*at == light.indices[k])
        sum[c] += double(light.values[k]) *
                  double(transfer.values[static_cast<std::size_t>(at - transfer.indices.begin())]);
    }
  }
  return transfer.channels == 1 ? glm::dvec3(sum.x) : sum;
}

void appendRow(HaarTransfer& transfer, const SparseRow& row) {
  transfer.indices.insert(transfer.indices.end(), row.indices.begin(), row.indices.end());
  transfer.values.insert(transfer.values.end(), row.values.begin(), row.values.end());
  transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.indices.size()));
}

HaarTransfer gatherBounce(const HaarTransfer& previous, std::span<const std::vector<Link>> links,
                          double relativeError) {
  HaarTransfer result{.faceSize = previous.faceSize,
                      .channels = 3,
                      .bounces = previous.bounces + 1,
                      .offsets = {0},
                      .indices = {},
                      .values = {}};
  std::vector<double> sum(coefficientCount(previous));
  std::vector<float> scratch;
  for (const std::vector<Link>& senders : links) {
    for (int c = 0; c < 3; ++c) {
      std::fill(sum.begin(), sum.end(), 0.0);
      for (const Link& link : senders) addRow(previous, rowOf(previous, link.sender, c), link.weight[c], sum);
      appendRow(result, keepDense(sum, relativeError, scratch));
    }
  }
  return result;
}

HaarTransfer addTransfer(const HaarTransfer& a, const HaarTransfer& b) {
  assert(a.faceSize == b.faceSize);
  const int channels = std::max(a.channels, b.channels);
  HaarTransfer result{.faceSize = a.faceSize,
                      .channels = channels,
                      .bounces = std::max(a.bounces, b.bounces),
                      .offsets = {0},
                      .indices = {},
                      .values = {}};
  std::vector<double> sum(coefficientCount(a));
  std::vector<float> scratch;
  const std::size_t vertices = rowCount(a) / static_cast<std::size_t>(a.channels);
  for (std::size_t v = 0; v < vertices; ++v) {
    for (int c = 0; c < channels; ++c) {
      std::fill(sum.begin(), sum.end(), 0.0);
      addRow(a, rowOf(a, v, c), 1.0, sum);
      addRow(b, rowOf(b, v, c), 1.0, sum);
      appendRow(result, keepDense(sum, 0.0, scratch));
    }
  }
  return result;
}

}  // namespace prelight::haar
