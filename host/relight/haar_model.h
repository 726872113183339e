#pragma once

#include <span>
#include <vector>

#include "basis/haar_selection.h"
#include "prelight/bake.h"

namespace prelight::haar {

/// Second moments of the rows of a transfer, E[T_i T_j] = sum_k principal_ki principal_kj + (i = j) rest_i^2:
/// the directions in which rows vary together, and what is left, as if it were uncorrelated. With it the
/// light's chosen coefficients can make up for those that are left out.
struct TransferModel {
  int rank = 0;
  std::vector<float> rms;        ///< [i], coefficientRms(): the weights by which coefficients are chosen
  std::vector<float> principal;  ///< [k][i]
  std::vector<float> rest;       ///< [i], > 0 where rms is
};

/// Directions of a model from which on more of them gain little (docs/wavelets.md).
constexpr int usualRank = 16;

/// Model of a transfer from 4096 of its rows at most, evenly spaced over vertices and channels, by `rank` >=
/// 0 directions of greatest moment (subspace iteration from a fixed start). Fewer rows than `rank` lower it.
TransferModel modelTransfer(const HaarTransfer& transfer, int rank);

/// The values for the indices of `selection` with which the expected square of the error is least under the
/// model. Without principal directions they are the light's own. Costs rank multiplications per coefficient
/// of the light and a rank x rank system.
SparseLight fitSelection(std::span<const float> light, const SparseLight& selection,
                         const TransferModel& model);

/// The `count` most important coefficients of a light with fitted values: selectLight() by the model's
/// weights, then fitSelection().
SparseLight selectFitted(std::span<const float> light, std::size_t count, const TransferModel& model);

/// The relative RMS error to be expected of results lit by a part of a light, under the model.
double expectedError(std::span<const float> light, const SparseLight& part, const TransferModel& model);

}  // namespace prelight::haar
