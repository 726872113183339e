#include "techniques/haar/haar_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <random>

#include "basis/cube_map.h"
#include "techniques/haar/haar_relight.h"

// [1] Halko, Martinsson and Tropp, "Finding structure with randomness", 2011: subspace iteration.

namespace prelight::haar {
namespace {

constexpr std::size_t maxRows = 4096;
constexpr int iterations = 6;
// Least remainder relative to the RMS, which keeps the system solvable if the directions explain everything.
constexpr double leastRest = 1e-3;

using Vectors = std::vector<std::vector<double>>;  ///< [k][i]

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Orthonormalises by Gram-Schmidt, twice for accuracy. Linearly dependent vectors become 0.
void orthonormalise(Vectors& vectors) {
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    const double before = std::sqrt(dot(vectors[k], vectors[k]));
    for (int round = 0; round < 2; ++round) {
      for (std::size_t j = 0; j < k; ++j) {
        const double along = dot(vectors[k], vectors[j]);
        for (std::size_t i = 0; i < vectors[k].size(); ++i) vectors[k][i] -= along * vectors[j][i];
      }
    }
    const double length = std::sqrt(dot(vectors[k], vectors[k]));
    const double scale = length > 1e-12 * before ? 1.0 / length : 0.0;
    for (double& value : vectors[k]) value *= scale;
  }
}

/// Returns representative rows of the transfer: vertices evenly, channels in turn.
std::vector<std::size_t> sampleRows(const HaarTransfer& transfer) {
  const auto channels = static_cast<std::size_t>(transfer.channels);
  const std::size_t rows = transfer.offsets.size() - 1, vertices = rows / channels;
  const std::size_t count = std::min(rows, maxRows);
  std::vector<std::size_t> sample(count);
  for (std::size_t i = 0; i < count; ++i) sample[i] = i * vertices / count * channels + i % channels;
  return sample;
}

/// Transposes [k][i] to [i][k], so that each entry of a row is adjacent to the values of all vectors.
std::vector<double> interleaved(const Vectors& vectors) {
  std::vector<double> sideBySide(vectors.size() * vectors[0].size());
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    for (std::size_t i = 0; i < vectors[k].size(); ++i) sideBySide[i * vectors.size() + k] = vectors[k][i];
  }
  return sideBySide;
}

/// Computes the products of a row with all vectors, [i][k].
void project(const HaarTransfer& transfer, std::size_t row, std::span<const double> vectors,
             std::vector<double>& products) {
  const std::size_t count = products.size();
  std::fill(products.begin(), products.end(), 0.0);
  for (std::uint32_t e = transfer.offsets[row]; e < transfer.offsets[row + 1]; ++e) {
    const double value = transfer.values[e];
    const double* at = vectors.data() + transfer.indices[e] * count;
    for (std::size_t k = 0; k < count; ++k) products[k] += value * at[k];
  }
}

/// Does one step of subspace iteration, which multiplies the vectors by R^T R.
void multiply(const HaarTransfer& transfer, std::span<const std::size_t> rows, Vectors& vectors) {
  const std::size_t count = vectors.size();
  const std::vector<double> sideBySide = interleaved(vectors);
  std::vector<double> result(sideBySide.size(), 0.0);
  std::vector<double> products(count);
  for (const std::size_t row : rows) {
    project(transfer, row, sideBySide, products);
    for (std::uint32_t e = transfer.offsets[row]; e < transfer.offsets[row + 1]; ++e) {
      const double value = transfer.values[e];
      double* at = result.data() + transfer.indices[e] * count;
      for (std::size_t k = 0; k < count; ++k) at[k] += value * products[k];
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < vectors[k].size(); ++i) vectors[k][i] = result[i * count + k];
  }
}

/// Returns the lower triangle L of a positive semidefinite matrix, A = L L^T; null directions become 0.
Vectors cholesky(const Vectors& a) {
  const std::size_t n = a.size();
  Vectors lower(n, std::vector<double>(n, 0.0));
  for (std::size_t j = 0; j < n; ++j) {
    double diagonal = a[j][j];
    for (std::size_t k = 0; k < j; ++k) diagonal -= lower[j][k] * lower[j][k];
    if (diagonal <= 1e-15 * a[j][j]) continue;
    lower[j][j] = std::sqrt(diagonal);
    for (std::size_t i = j + 1; i < n; ++i) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k];
      lower[i][j] = sum / lower[j][j];
    }
  }
  return lower;
}

/// Solves L L^T x = b for a regular L.
std::vector<double> solve(const Vectors& lower, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= lower[i][k] * b[k];
    b[i] /= lower[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= lower[k][i] * b[k];
    b[i] /= lower[i][i];
  }
  return b;
}

/// Returns a light minus a part of it, as a dense light.
std::vector<float> remainder(std::span<const float> light, const SparseLight& part) {
  std::vector<float> rest(light.begin(), light.end());
  const std::size_t count = light.size() / 3;
  for (std::size_t k = 0; k < part.indices.size(); ++k) {
    for (int c = 0; c < 3; ++c)
      rest[static_cast<std::size_t>(c) * count + part.indices[k]] -= part.values[k][c];
  }
  return rest;
}

/// Returns the expected squared contribution of a light to the results under the model, summed over channels.
double expectedSquare(std::span<const float> light, const TransferModel& model) {
  const std::size_t count = model.rms.size();
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const float* channel = light.data() + c * count;
    for (std::size_t i = 0; i < count; ++i) {
      const double value = static_cast<double>(channel[i]) * model.rest[i];
      sum += value * value;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(model.rank); ++k) {
      double product = 0.0;
      for (std::size_t i = 0; i < count; ++i)
        product += double(channel[i]) * double(model.principal[k * count + i]);
      sum += product * product;
    }
  }
  return sum;
}

double principalAt(const TransferModel& model, std::size_t k, std::uint32_t i) {
  return model.principal[k * model.rms.size() + i];
}

/// Returns 1 + M D^-1 M^T over the given coefficients, for fitSelection().
Vectors normalSystem(std::span<const std::uint32_t> indices, const TransferModel& model) {
  const auto rank = static_cast<std::size_t>(model.rank);
  Vectors system(rank, std::vector<double>(rank, 0.0));
  for (std::size_t a = 0; a < rank; ++a) {
    system[a][a] = 1.0;
    for (std::size_t b = 0; b < rank; ++b) {
      for (const std::uint32_t i : indices) {
        const double rest = model.rest[i];
        if (rest > 0.0) system[a][b] += principalAt(model, a, i) * principalAt(model, b, i) / (rest * rest);
      }
    }
  }
  return system;
}

/// Returns sums of rows with fixed pseudo-random weights, the start of the iteration [1].
Vectors mixRows(const HaarTransfer& transfer, std::span<const std::size_t> rows, std::size_t vectorCount) {
  Vectors vectors(vectorCount, std::vector<double>(cubeTexelCount(transfer.faceSize), 0.0));
  std::mt19937 random(1);
  for (const std::size_t row : rows) {
    for (std::vector<double>& vector : vectors) {
      const double weight = static_cast<double>(random()) / 2147483648.0 - 1.0;
      for (std::uint32_t e = transfer.offsets[row]; e < transfer.offsets[row + 1]; ++e) {
        vector[transfer.indices[e]] += weight * static_cast<double>(transfer.values[e]);
      }
    }
  }
  return vectors;
}

/// Returns the mean products of the rows' components along the vectors.
Vectors momentsAlong(const HaarTransfer& transfer, std::span<const std::size_t> rows,
                     const Vectors& vectors) {
  Vectors moments(vectors.size(), std::vector<double>(vectors.size(), 0.0));
  const std::vector<double> sideBySide = interleaved(vectors);
  std::vector<double> products(vectors.size());
  for (const std::size_t row : rows) {
    project(transfer, row, sideBySide, products);
    for (std::size_t a = 0; a < vectors.size(); ++a) {
      for (std::size_t b = 0; b < vectors.size(); ++b) {
        moments[a][b] += products[a] * products[b] / static_cast<double>(rows.size());
      }
    }
  }
  return moments;
}

}  // namespace

TransferModel modelTransfer(const HaarTransfer& transfer, int rank) {
  assert(rank >= 0);
  TransferModel model{.rank = 0, .rms = coefficientRms(transfer), .principal = {}, .rest = {}};
  const std::vector<std::size_t> rows = sampleRows(transfer);
  const std::size_t count = model.rms.size();
  const auto vectorCount = std::min<std::size_t>(static_cast<std::size_t>(rank), rows.size());
  model.rank = static_cast<int>(vectorCount);
  model.rest = model.rms;
  if (vectorCount == 0) return model;

  Vectors vectors = mixRows(transfer, rows, vectorCount);
  orthonormalise(vectors);
  for (int i = 0; i < iterations; ++i) {
    multiply(transfer, rows, vectors);
    orthonormalise(vectors);
  }

  // E[T T^T] along the vectors is V B V^T; with B = L L^T, the principal rows are those of L^T V^T.
  const Vectors lower = cholesky(momentsAlong(transfer, rows, vectors));
  model.principal.resize(vectorCount * count);
  for (std::size_t i = 0; i < count; ++i) {
    double explained = 0.0;
    for (std::size_t k = 0; k < vectorCount; ++k) {
      double value = 0.0;
      for (std::size_t a = k; a < vectorCount; ++a) value += lower[a][k] * vectors[a][i];
      model.principal[k * count + i] = static_cast<float>(value);
      explained += value * value;
    }
    const double square = static_cast<double>(model.rms[i]) * model.rms[i];
    const double least = leastRest * model.rms[i];
    model.rest[i] = static_cast<float>(std::sqrt(std::max(square - explained, least * least)));
  }
  return model;
}

SparseLight fitSelection(std::span<const float> light, const SparseLight& selection,
                         const TransferModel& model) {
  SparseLight fitted{selection.indices, {}};
  const std::size_t count = model.rms.size();
  for (const std::uint32_t i : selection.indices) {
    fitted.values.push_back({light[i], light[count + i], light[2 * count + i]});
  }
  const auto rank = static_cast<std::size_t>(model.rank);
  if (rank == 0) return fitted;
  // Let M be the principal rows of the selected coefficients, D their remainder, and m the missing
  // contribution of the others along the principal directions. The expected square is least at D^-1 M^T (1 +
  // M D^-1 M^T)^-1 m.
  const Vectors system = cholesky(normalSystem(selection.indices, model));
  const std::vector<float> missing = remainder(light, fitted);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::span<const float> channel = std::span(missing).subspan(c * count, count);
    std::vector<double> along(rank, 0.0);
    for (std::size_t k = 0; k < rank; ++k) {
      for (std::uint32_t i = 0; i < count; ++i)
        along[k] += principalAt(model, k, i) * static_cast<double>(channel[i]);
    }
    along = solve(system, std::move(along));
    for (std::size_t j = 0; j < fitted.indices.size(); ++j) {
      const std::uint32_t i = fitted.indices[j];
      const double rest = model.rest[i];
      if (rest <= 0.0) continue;
      double change = 0.0;
      for (std::size_t k = 0; k < rank; ++k) change += principalAt(model, k, i) * along[k];
      fitted.values[j][static_cast<int>(c)] += static_cast<float>(change / (rest * rest));
    }
  }
  return fitted;
}

SparseLight selectFitted(std::span<const float> light, std::size_t count, const TransferModel& model) {
  return fitSelection(light, selectLight(light, model.rms, count), model);
}

double expectedError(std::span<const float> light, const SparseLight& part, const TransferModel& model) {
  const double whole = expectedSquare(light, model);
  return whole > 0.0 ? std::sqrt(expectedSquare(remainder(light, part), model) / whole) : 0.0;
}

}  // namespace prelight::haar
