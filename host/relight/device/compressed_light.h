#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/transfer.h"

namespace prelight {

/// A light prepared for compressed transfer, once per light: it contains all products with data that vertices
/// share (Kautz 2004), so that the work per vertex is a sum over its own numbers.
///
///   Half          terms[i] = L_i;
///                 exit[c] = sum_i terms[i][c] half[v][c'][i], c' = c, or 0 with one channel
///   Band8         terms[0] = sum_i L_i offset_l, terms[1 + i] = L_i scale_l;
///                 exit[c] = terms[0][c] + sum_i terms[1 + i][c] byte[v][c'][i]
///   Pca, Vq, Cpca terms[k (1 + K) + 0] = L . mean_k, terms[k (1 + K) + 1 + j] = L . basis_kj, ranges of byte
///                 weights multiplied in; exit[c] = terms[k (1 + K)][c] + sum_j terms[.. + 1 + j][c]
///                 stored[v][j]
///
/// exit is the radiance before the receiver's albedo.
struct CompressedLight {
  std::vector<glm::vec3> terms;
};

/// Prepares a light. `light` holds its coefficients, [channel][i], 3 x order^2, as sh::projectEnvironment
/// yields them. Throws UsageError for another number of coefficients.
CompressedLight lightOf(const CompressedTransfer& compressed, std::span<const double> light);

/// Returns the radiance before albedo of every vertex, computed in double precision on the host, [vertex].
std::vector<glm::dvec3> relight(const CompressedTransfer& compressed, const CompressedLight& light);

}  // namespace prelight
