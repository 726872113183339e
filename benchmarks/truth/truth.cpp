#include "benchmarks/truth/truth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "benchmarks/run/time_shares.h"
#include "benchmarks/truth/picture_error.h"

namespace prelight::benchmarks {

namespace {

Picture sumOf(std::span<TracedLight* const> parts, std::size_t half) {
  Picture sum = parts.front()->half(half);
  for (const TracedLight* part : parts.subspan(1)) {
    const Picture more = part->half(half);
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += more.pixels[i];
  }
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
  truth.picture = truth.first;
  for (std::size_t i = 0; i < truth.picture.pixels.size(); ++i)
    truth.picture.pixels[i] = 0.5f * (truth.first.pixels[i] + truth.second.pixels[i]);
  truth.displayed = displayed(truth.picture);
}

/// A block of a part, and what another pass is worth.
struct Candidate {
  TracedLight* part = nullptr;
  std::size_t block = 0;
  double variance = 0.0;  ///< variance of a pass of each half, summed over the block's pixels and channels

  double worth() const {
    const double n = part->passes(block);
    return variance / (n * (n + 1.0) * part->secondsOf(block));
  }
};

/// Share of the mean variance of a part that every block counts for at least: the first look misses what is
/// rare.
constexpr double leastShare = 0.1;

std::vector<Candidate> candidatesOf(std::span<TracedLight* const> parts) {
  Picture look = parts.front()->firstLook();
  for (const TracedLight* part : parts.subspan(1))
    for (std::size_t i = 0; i < look.pixels.size(); ++i) look.pixels[i] += part->firstLook().pixels[i];
  std::vector<Candidate> candidates;
  for (TracedLight* part : parts) {
    const std::size_t first = candidates.size();
    double sum = 0.0;
    for (std::size_t block = 0; block < part->blockCount(); ++block) {
      Candidate candidate{part, block, 0.0};
      for (std::size_t i = part->begin(block); i < part->end(block); ++i)
        for (int channel = 0; channel < 3; ++channel)
          if (look.pixels[i][channel] < 1.0f) candidate.variance += part->variance()[i][channel];
      sum += candidate.variance;
      candidates.push_back(candidate);
    }
    const double least = leastShare * sum / static_cast<double>(part->blockCount());
    for (std::size_t i = first; i < candidates.size(); ++i)
      candidates[i].variance = std::max(candidates[i].variance, least);
  }
  return candidates;
}

/// Which gains most in a second; nullptr: none has samples left.
Candidate* worthMost(std::vector<Candidate>& candidates, std::uint64_t mostSamples) {
  Candidate* best = nullptr;
  double most = 0.0;
  for (Candidate& candidate : candidates) {
    const double worth = candidate.worth();
    if (worth <= most || candidate.part->samples() >= mostSamples) continue;
    most = worth;
    best = &candidate;
  }
  return best;
}

/// Passes for a while. False: no samples were left.
bool traceFor(double seconds, std::vector<Candidate>& candidates, std::uint64_t mostSamples) {
  for (const Deadline end(seconds); !end.isPast();) {
    Candidate* best = worthMost(candidates, mostSamples);
    if (best == nullptr) return false;
    best->part->trace(best->block);
  }
  return true;
}

}  // namespace

std::vector<glm::vec3> displayed(const Picture& picture) {
  std::vector<glm::vec3> result;
  result.reserve(picture.pixels.size());
  for (const glm::vec3& pixel : picture.pixels) result.push_back(toneMap(pixel));
  return result;
}

std::string samplesText(const Truth& truth) { return fmt::format("{}", fmt::join(truth.samples, " + ")); }

Truth traceTruth(std::span<TracedLight* const> parts, const TruthEffort& effort,
                 const std::function<bool(const Truth&)>& isEnough) {
  constexpr double leastTurn = 0.5, turnShare = 0.1;  // s, and of what was traced: pictures are compared then
  Truth truth;
  for (TracedLight* part : parts)
    if (part->passes(0) == 0)
      for (std::size_t block = 0; block < part->blockCount(); ++block) part->trace(block);
  add(parts, truth);
  std::vector<Candidate> candidates = candidatesOf(parts);
  const Deadline end(effort.mostSeconds);
  while (!isEnough(truth) && !end.isPast()) {
    const double turn = std::max(leastTurn, turnShare * truth.seconds);
    if (!traceFor(std::min(turn, end.left()), candidates, effort.mostSamples)) break;
    add(parts, truth);
  }
  finish(truth);
  return truth;
}

}  // namespace prelight::benchmarks
