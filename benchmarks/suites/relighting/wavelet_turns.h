#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "basis/cube_map.h"
#include "benchmarks/suites/relighting/flicker.h"
#include "benchmarks/suites/relighting/relighting_suite.h"
#include "benchmarks/suites/relighting/sphere_receivers.h"
#include "prelight/progress.h"
#include "techniques/haar/haar_model.h"

namespace prelight::benchmarks {

struct NamedLight {
  std::string name;
  CubeMap map;
};

/// A sky that brightens towards the zenith ("smooth"), the same with a sun of 3 degrees ("sun"), four bright
/// windows in a dark room ("windows"), and the given pictures of skies, named after their files.
std::vector<NamedLight> waveletLights(int faceSize, const std::vector<std::filesystem::path>& skies);

/// Receivers and what is known of their transfer, which the measurements of wavelets share.
struct WaveletScene {
  CubeTexels texels;
  SphereReceivers receivers;
  HaarTransfer transfer;       ///< with all coefficients
  haar::TransferModel model;   ///< model of 16 directions
  std::vector<float> columns;  ///< the transfer as [coefficient][receiver]

  WaveletScene(int faceSize, int receiverCount);

  /// As haar::relight(), reading only what the light's coefficients need.
  Lit relight(const haar::SparseLight& light) const;
};

/// Error and flicker of lights that turn by a degree a frame: resampled at points and by area, chosen
/// plainly, with fitted values, with soft and with steady choice, and turned in the wavelet basis.
void measureTurns(const WaveletScene& scene, const std::vector<NamedLight>& lights,
                  const RelightingOptions& options, const Progress& progress,
                  std::vector<BenchmarkResult>& results);

/// Haar wavelets against the quincunx lattice of as many values, at the same numbers of coefficients.
void compareWithQuincunx(const WaveletScene& scene, const RelightingOptions& options,
                         const Progress& progress, std::vector<BenchmarkResult>& results);

}  // namespace prelight::benchmarks
