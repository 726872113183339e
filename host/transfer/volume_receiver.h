#pragma once

#include <span>
#include <vector>

#include "basis/sh_products.h"
#include "prelight/transfer.h"
#include "transfer/volume_cells.h"

namespace prelight {

/// Where a vertex's values go.
struct ReceivedTransfer {
  std::span<float> sh;      ///< [channel 3][i] of the volume's order: HarmonicTransfer's
  std::span<float> lights;  ///< [channel 3][group]: LightGroupTransfer's, without direct light; may be empty
};

/// Transfer of a diffuse vertex of an object that stands in a volume. What arrives there is that of the cells
/// around it, the vertex's own transfer says what the object makes of it:
///
///   T[c][i] = sum_k (V Y_i)_k own[c][k] + sum_j sent[c][j][i] own[c][j]
///   lights[c][g] = sum_j lights[c][j][g] own[c][j]
///
/// V is the cells' visibility, cut to the volume's order, as is the product.
class VolumeReceiver {
 public:
  /// The volume outlives it.
  explicit VolumeReceiver(const VolumeTransfer& volume);

  /// Bands of an object's own transfer.
  static int ownOrder(const VolumeTransfer& volume);

  /// `own`: SH transfer of the vertex without the scene, [channel][k], of ownOrder() in `ownChannels`.
  /// `sentShare`: of what surfaces send, the part that arrives.
  void receive(std::span<const VolumeCorner> corners, std::span<const float> own, int ownChannels,
               double sentShare, const ReceivedTransfer& into) const;

 private:
  void addSent(std::span<const VolumeCorner> corners, std::size_t channel, std::span<const float> own,
               std::span<double> sum) const;

  const VolumeTransfer& volume_;
  sh::ShProduct product_;
};

}  // namespace prelight
