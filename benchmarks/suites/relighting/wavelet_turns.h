#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "basis/cube_map.h"
#include "benchmarks/suites/relighting/relighting_suite.h"
#include "benchmarks/suites/relighting/sphere_receivers.h"
#include "prelight/progress.h"
#include "techniques/haar/haar_model.h"

namespace prelight::benchmarks {

/// Exit radiance over albedo at every receiver.
using Lit = std::vector<glm::dvec3>;

/// Returns the root of the sum of squared distances divided by that of squared lengths.
double relativeRms(const Lit& values, const Lit& exact);

/// Measures how steady compressed lighting is while a light turns. Changes of the exact lighting between
/// frames do not count.
class FlickerMeter {
 public:
  void add(const Lit& shown, const Lit& exact, std::size_t coefficients);

  double error() const;    ///< relative RMS of shown - exact over all frames
  double flicker() const;  ///< RMS over frames of the change of shown - exact, over the RMS of exact
  double worst() const;    ///< error of the worst frame
  double jump() const;  ///< greatest change of the receivers' mean of shown - exact, over the mean of exact
  double coefficients() const;  ///< mean over frames

 private:
  Lit before_;  ///< shown - exact angle of the last frame
  int frames_ = 0;
  double coefficients_ = 0.0;
  double errorSquares_ = 0.0;
  double exactSquares_ = 0.0;
  double changeSquares_ = 0.0;
  double worst_ = 0.0;
  double jump_ = 0.0;
};

struct NamedLight {
  std::string name;
  CubeMap map;
};

/// Returns a sky that brightens towards the zenith ("smooth"), that sky with a sun of 3 degrees ("sun"), four
/// bright windows in a dark room ("windows"), and the given pictures of skies, named after their files.
std::vector<NamedLight> waveletLights(int faceSize, const std::vector<std::filesystem::path>& skies);

/// Receivers and their transfer, which the measurements of wavelets share.
struct WaveletScene {
  CubeTexels texels;
  SphereReceivers receivers;
  HaarTransfer transfer;       ///< with all coefficients
  haar::TransferModel model;   ///< model of 16 directions
  std::vector<float> columns;  ///< the transfer as [coefficient][receiver]

  WaveletScene(int faceSize, int receiverCount);

  /// Returns the same as haar::relight(), but reads only the columns of the light's coefficients.
  Lit relight(const haar::SparseLight& light) const;
};

/// Measures error and flicker of lights that turn by one degree per frame: resampled at points and by area;
/// with plain, fitted, soft and steady choice of coefficients; and turned in the wavelet basis.
void measureTurns(const WaveletScene& scene, const std::vector<NamedLight>& lights,
                  const RelightingOptions& options, const Progress& progress,
                  std::vector<BenchmarkResult>& results);

/// Compares Haar wavelets with the quincunx lattice of as many values, at the same numbers of coefficients.
void compareWithQuincunx(const WaveletScene& scene, const RelightingOptions& options,
                         const Progress& progress, std::vector<BenchmarkResult>& results);

}  // namespace prelight::benchmarks
