#include "benchmarks/truth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "benchmarks/flip.h"
#include "benchmarks/measure.h"

namespace prelight::benchmarks {

namespace {

/// Samples of a pixel that are one sequence: the more, the better they spread.
constexpr std::uint64_t samplesPerPass = 64;

Picture sumOf(std::span<TracedLight* const> parts, int half) {
  Picture sum = parts.front()->half(half);
  for (std::size_t part = 1; part < parts.size(); ++part)
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += parts[part]->half(half).pixels[i];
  return sum;
}

void add(std::span<TracedLight* const> parts, Truth& truth) {
  truth.first = sumOf(parts, 0);
  truth.second = sumOf(parts, 1);
  // The halves differ by sqrt(2) of a half's error, which is sqrt(2) of their mean's.
  truth.rmse = 0.5 * pictureRmse(truth.first, truth.second);
  truth.samples.clear();
  truth.seconds = 0.0;
  for (const TracedLight* part : parts) {
    truth.samples.push_back(part->samples());
    truth.seconds += part->seconds();
  }
}

void finish(Truth& truth) {
  truth.flip = flip(displayed(truth.first), displayed(truth.second), truth.first.width, truth.first.height);
  truth.picture = truth.first;
  for (std::size_t i = 0; i < truth.picture.pixels.size(); ++i)
    truth.picture.pixels[i] = 0.5f * (truth.first.pixels[i] + truth.second.pixels[i]);
  truth.displayed = displayed(truth.picture);
}

/// Which loses most of its variance in a second; nullptr: none has samples left within the effort.
TracedLight* worthMost(std::span<TracedLight* const> parts, const TruthEffort& effort, double left) {
  TracedLight* best = nullptr;
  double most = 0.0;
  for (TracedLight* part : parts) {
    if (2 * part->samples() > effort.mostSamples || part->nextSeconds() > left) continue;
    const double worth = part->rmse() * part->rmse() / part->nextSeconds();
    if (worth <= most) continue;
    most = worth;
    best = part;
  }
  return best;
}

}  // namespace

std::vector<glm::vec3> displayed(const Picture& picture) {
  std::vector<glm::vec3> result;
  result.reserve(picture.pixels.size());
  for (const glm::vec3& pixel : picture.pixels) result.push_back(toneMap(pixel));
  return result;
}

std::string samplesText(const Truth& truth) { return fmt::format("{}", fmt::join(truth.samples, " + ")); }

TracedLight::TracedLight(const reference::ReferenceInputs& inputs, reference::ReferenceRequest request,
                         const Device& device, const Progress& progress)
    : inputs_(inputs),
      device_(device),
      progress_(progress),
      next_(std::min(request.samples, samplesPerPass)) {
  request.samplesPerPass = static_cast<std::uint32_t>(next_);
  for (std::uint64_t seed = 0; seed < halves_.size(); ++seed) {
    request.seed = seed;
    halves_[seed] = {request, reference::Film(request.width, request.height)};
  }
}

std::uint64_t TracedLight::samples() const {
  return 2 * halves_[0].film.passes * halves_[0].request.samplesPerPass;
}

/// The first grow() makes as many samples as the second, each later one twice as many as the one before.
double TracedLight::nextSeconds() const { return std::max(seconds_, 1e-6); }

void TracedLight::grow() {
  for (std::size_t i = 0; i < halves_.size(); ++i) {
    halves_[i].request.samples = next_;
    reference::ReferenceReport report;
    StopOnly quiet(progress_);
    reference::renderReference(
        inputs_, halves_[i].request, device_, quiet, [] {}, halves_[i].film, report);
    pictures_[i] = halves_[i].film.picture();
    seconds_ += report.seconds;
  }
  next_ *= 2;
  rmse_ = 0.5 * pictureRmse(pictures_[0], pictures_[1]);
}

Truth traceTruth(std::span<TracedLight* const> parts, const TruthEffort& effort,
                 const std::function<bool(const Truth&)>& isEnough) {
  Truth truth;
  for (TracedLight* part : parts)
    if (part->samples() == 0) part->grow();
  add(parts, truth);
  double spent = truth.seconds;
  while (!isEnough(truth)) {
    TracedLight* part = worthMost(parts, effort, effort.mostSeconds - spent);
    if (part == nullptr) break;
    part->grow();
    add(parts, truth);
    spent = truth.seconds;
  }
  finish(truth);
  return truth;
}

}  // namespace prelight::benchmarks
