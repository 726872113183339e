#include "benchmarks/truth.h"

#include <algorithm>
#include <array>

#include "benchmarks/flip.h"
#include "benchmarks/measure.h"

namespace prelight::benchmarks {

namespace {

/// Samples of a pixel that are one sequence: the more, the better they spread, but so many are traced at
/// least.
constexpr std::uint64_t mostSamplesPerPass = 128;

/// One of a truth's two pictures, as it grows.
struct Half {
  reference::ReferenceRequest request;
  reference::Film film;

  Half(const reference::ReferenceRequest& asked, std::uint64_t seed)
      : request(asked), film(asked.width, asked.height) {
    request.seed = seed;
  }

  /// Seconds that it took.
  double grow(const reference::ReferenceInputs& inputs, std::uint64_t samples, const Device& device,
              const Progress& progress) {
    request.samples = samples;
    reference::ReferenceReport report;
    StopOnly quiet(progress);
    reference::renderReference(
        inputs, request, device, quiet, [] {}, film, report);
    return report.seconds;
  }
};

void compare(const std::array<Half, 2>& halves, Truth& truth) {
  truth.first = halves[0].film.picture();
  truth.second = halves[1].film.picture();
  // The halves differ by sqrt(2) of a half's error, which is sqrt(2) of their mean's.
  truth.rmse = 0.5 * pictureRmse(truth.first, truth.second);
  truth.samples = 2 * halves[0].film.passes * halves[0].request.samplesPerPass;
}

void finish(Truth& truth) {
  truth.flip = flip(displayed(truth.first), displayed(truth.second), truth.first.width, truth.first.height);
  truth.picture = truth.first;
  for (std::size_t i = 0; i < truth.picture.pixels.size(); ++i)
    truth.picture.pixels[i] = 0.5f * (truth.first.pixels[i] + truth.second.pixels[i]);
  truth.displayed = displayed(truth.picture);
}

}  // namespace

std::vector<glm::vec3> displayed(const Picture& picture) {
  std::vector<glm::vec3> result;
  result.reserve(picture.pixels.size());
  for (const glm::vec3& pixel : picture.pixels) result.push_back(toneMap(pixel));
  return result;
}

Truth traceTruth(const reference::ReferenceInputs& inputs, reference::ReferenceRequest request,
                 const TruthEffort& effort, const Device& device, const Progress& progress,
                 const std::function<bool(const Truth&)>& isEnough) {
  const std::uint64_t most = std::max<std::uint64_t>(effort.mostSamples / 2, 1);
  request.samplesPerPass = static_cast<std::uint32_t>(std::min(most, mostSamplesPerPass));
  std::array<Half, 2> halves = {Half(request, 0), Half(request, 1)};
  Truth truth;
  truth.depth = request.depth;
  for (std::uint64_t samples = request.samplesPerPass; samples <= most; samples *= 2) {
    double spent = 0.0;
    for (Half& half : halves) spent += half.grow(inputs, samples, device, progress);
    truth.seconds += spent;
    compare(halves, truth);
    const bool wasFirst = samples == request.samplesPerPass;
    const double next = wasFirst ? spent : 2.0 * spent;  // as many as there are
    if (isEnough(truth) || truth.seconds + next > effort.mostSeconds) break;
  }
  finish(truth);
  return truth;
}

}  // namespace prelight::benchmarks
