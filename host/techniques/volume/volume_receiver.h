#pragma once

#include <span>
#include <vector>

#include "basis/sh_products.h"
#include "prelight/transfer.h"
#include "techniques/volume/volume_light.h"

namespace prelight {

/// Destination of a vertex's values.
struct ReceivedTransfer {
  std::span<float> sh;  ///< [channel 3][i] of the volume's order, as in HarmonicTransfer
  /// [channel 3][group], as in LightGroupTransfer but without direct light; may be empty.
  std::span<float> lights;
};

/// Transfer of a diffuse vertex of an object in a volume. Incident light is that of the cells around it, and
/// the vertex's own transfer describes its reception:
///
///   T[c][i] = sum_k (V Y_i)_k own[c][k] + sum_j sent[c][j][i] own[c][j]
///   lights[c][g] = sum_j lights[c][j][g] own[c][j]
///
/// V is the cells' visibility. V and the product are truncated to the volume's order.
class VolumeReceiver {
 public:
  /// The volume must outlive the object.
  explicit VolumeReceiver(const VolumeTransfer& volume);

  /// Returns the bands of an object's own transfer.
  static int ownOrder(const VolumeTransfer& volume);

  /// Computes the transfer of a vertex, which replaces the values in `into`. `own` is its SH transfer without
  /// the scene, [channel][k], of ownOrder() in `ownChannels` channels. `sentShare` is the share of light from
  /// surfaces that arrives.
  void receive(std::span<const VolumeCorner> corners, std::span<const float> own, int ownChannels,
               double sentShare, const ReceivedTransfer& into) const;

 private:
  void addSent(std::span<const VolumeCorner> corners, std::size_t channel, std::span<const float> own,
               std::span<double> sum) const;

  const VolumeTransfer& volume_;
  sh::ShProduct product_;
};

}  // namespace prelight
