#pragma once

#include <span>
#include <vector>

#include "basis/haar.h"
#include "prelight/bake.h"

namespace prelight::haar {

/// Model of the second moments of a transfer's rows: E[T_i T_j] = sum_k principal_ki principal_kj + (i = j)
/// rest_i^2, that is, principal directions plus an uncorrelated remainder. With it, the values of a light's
/// selected coefficients can compensate for those that are left out.
struct TransferModel {
  int rank = 0;
  std::vector<float> rms;        ///< [i], coefficientRms(), the weights of selection
  std::vector<float> principal;  ///< [k][i]
  std::vector<float> rest;       ///< [i], > 0 where rms is
};

/// Number of principal directions beyond which more gain little (docs/notes/wavelets.md).
constexpr int usualRank = 16;

/// Models a transfer from at most 4096 of its rows, evenly spaced over vertices and channels, by `rank` >= 0
/// principal directions (subspace iteration from a fixed start). The rank is at most the number of rows.
TransferModel modelTransfer(const HaarTransfer& transfer, int rank);

/// Returns values for the indices of `selection` that minimise the expected squared error under the model.
/// Without principal directions they are the light's own values. Costs `rank` multiplications per coefficient
/// of the light and the solution of a rank x rank system.
SparseLight fitSelection(std::span<const float> light, const SparseLight& selection,
                         const TransferModel& model);

/// Returns the `count` most important coefficients of a light with fitted values: selectLight() with the
/// model's weights, then fitSelection().
SparseLight selectFitted(std::span<const float> light, std::size_t count, const TransferModel& model);

/// Returns the expected relative RMS error of results with a part of a light's coefficients, under the model.
double expectedError(std::span<const float> light, const SparseLight& part, const TransferModel& model);

}  // namespace prelight::haar
