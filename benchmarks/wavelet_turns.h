#pragma once

#include <vector>

#include "benchmarks/flicker.h"
#include "benchmarks/sphere_receivers.h"
#include "benchmarks/suite.h"
#include "benchmarks/wavelet_lights.h"
#include "prelight/progress.h"
#include "relight/haar_model.h"

namespace prelight::benchmarks {

/// Receivers and what is known of their transfer, which the measurements of wavelets share.
struct WaveletScene {
  CubeTexels texels;
  SphereReceivers receivers;
  HaarTransfer transfer;       ///< with all coefficients
  haar::TransferModel model;   ///< of 16 directions
  std::vector<float> columns;  ///< the transfer as [coefficient][receiver]

  WaveletScene(int faceSize, int receiverCount);

  /// As haar::relight(), reading only what the light's coefficients need.
  Lit relight(const haar::SparseLight& light) const;
};

/// Error and flicker of lights that turn by a degree a frame: resampled at points and by area, chosen
/// plainly, with fitted values, with soft and with steady choice, and turned in the wavelet basis.
void measureTurns(const WaveletScene& scene, const std::vector<NamedLight>& lights,
                  const BenchmarkOptions& options, const Progress& progress,
                  std::vector<BenchmarkResult>& results);

/// Haar wavelets against the quincunx lattice of as many values, at the same numbers of coefficients.
void compareWithQuincunx(const WaveletScene& scene, const BenchmarkOptions& options, const Progress& progress,
                         std::vector<BenchmarkResult>& results);

}  // namespace prelight::benchmarks
