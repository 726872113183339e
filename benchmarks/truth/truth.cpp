#include "benchmarks/truth/truth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "base/state_log.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/truth/picture_error.h"
#include "integrators/reference.h"

namespace prelight::benchmarks {

namespace {

/// Samples of a pixel that form one sequence: longer sequences are spread more evenly.
constexpr std::uint64_t samplesOfPass = 256;
constexpr std::uint64_t samplesOfLook = 64;
constexpr std::size_t mostBlockPixels =
    256;  // enough paths for a launch, few enough that blocks differ in variance
constexpr std::uint64_t seedOfLook = 1;  // the samples have another seed
constexpr const char* kind = "traced light";
constexpr const char* record = "light";

LitScene litSceneOf(const reference::ReferenceInputs& inputs) {
  return {inputs.scene, inputs.images, inputs.lights, inputs.sky, inputs.skyRotation};
}

reference::ReferenceRequest ofPasses(reference::ReferenceRequest request, std::uint64_t samples,
                                     std::uint64_t seed) {
  request.samples = std::min(request.samples, samples);
  request.samplesPerPass = static_cast<std::uint32_t>(request.samples);
  request.seed = seed;
  return request;
}

}  // namespace

TracedLight::TracedLight(const reference::ReferenceInputs& inputs, reference::ReferenceRequest request,
                         const Device& device, const Progress& progress)
    : inputs_(inputs),
      request_(ofPasses(request, samplesOfPass, 0)),
      progress_(progress),
      device_(device.info()),
      scene_(litSceneOf(inputs), device, request.integrator != reference::Integrator::Whitted),
      tracer_(scene_, inputs.scene, inputs.camera, request_),
      blockPixels_(std::min<std::size_t>(mostBlockPixels, tracer_.blockPixels())) {
  const std::size_t pixels =
      static_cast<std::size_t>(request_.width) * static_cast<std::size_t>(request_.height);
  passes_.assign((pixels + blockPixels_ - 1) / blockPixels_, 0);
  seconds_.assign(passes_.size(), 0.0);
  for (std::vector<glm::dvec3>& sums : sums_) sums.assign(pixels, glm::dvec3(0.0));
  variance_.assign(pixels, glm::vec3(0.0f));
  firstLook_ = {request_.width, request_.height, std::vector<glm::vec3>(pixels, glm::vec3(0.0f))};
}

std::size_t TracedLight::end(std::size_t block) const {
  return std::min(begin(block) + blockPixels_, variance_.size());
}

/// Traces two passes; half of their squared difference is the variance of one.
void TracedLight::look() {
  looked_ = true;
  const reference::ReferenceRequest request = ofPasses(request_, samplesOfLook, seedOfLook);
  reference::PathTracer tracer(scene_, inputs_.scene, inputs_.camera, request);
  const double share = static_cast<double>(request.samples) / static_cast<double>(request_.samples);
  for (std::size_t block = 0; block < blockCount(); ++block) {
    progress_.check();
    const auto first = static_cast<std::uint32_t>(begin(block));
    const auto count = static_cast<std::uint32_t>(end(block)) - first;
    lookSeconds_ += benchmarks::secondsOf([&] {
      const std::vector<glm::vec4> a = tracer.trace(0, first, count);
      const std::vector<glm::vec4>& b = tracer.trace(1, first, count);
      for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 one(a[i]), other(b[i]);
        variance_[first + i] = 0.5f * (one - other) * (one - other) * static_cast<float>(share);
        firstLook_.pixels[first + i] = 0.5f * (one + other);
      }
    });
  }
}

void TracedLight::trace(std::size_t block) {
  if (!looked_) look();
  progress_.check();
  const auto first = static_cast<std::uint32_t>(begin(block));
  const auto count = static_cast<std::uint32_t>(end(block)) - first;
  seconds_[block] += benchmarks::secondsOf([&] {
    for (std::uint64_t half = 0; half < sums_.size(); ++half) {
      const std::vector<glm::vec4>& means =
          tracer_.trace(2 * std::uint64_t{passes_[block]} + half, first, count);
      for (std::size_t i = 0; i < count; ++i) sums_[half][first + i] += glm::dvec3(glm::vec3(means[i]));
    }
  });
  ++passes_[block];
}

double TracedLight::secondsOf(std::size_t block) const {
  return std::max(seconds_[block] / std::max(passes_[block], 1u), 1e-6);
}

std::uint64_t TracedLight::samples() const {
  std::uint64_t sum = 0;
  for (std::size_t block = 0; block < blockCount(); ++block)
    sum += passes_[block] * (end(block) - begin(block));
  return 2 * request_.samples * sum / variance_.size();
}

double TracedLight::seconds() const {
  return std::accumulate(seconds_.begin(), seconds_.end(), lookSeconds_);
}

Picture TracedLight::half(std::size_t which) const {
  Picture picture{request_.width, request_.height, std::vector<glm::vec3>(variance_.size())};
  for (std::size_t block = 0; block < blockCount(); ++block)
    for (std::size_t i = begin(block); i < end(block); ++i)
      picture.pixels[i] = glm::vec3(sums_[which][i] / static_cast<double>(passes_[block]));
  return picture;
}

StateKey TracedLight::key() const {
  StateKey key = reference::filmKey(inputs_, request_, device_);
  key.emplace_back("least length of paths", StateHash().value(request_.leastDepth).result());
  key.emplace_back("pixels of a block", StateHash().value(blockPixels_).result());
  return key;
}

/// Returns the name of the file that keeps this light; it differs between scenes.
std::filesystem::path TracedLight::fileIn(const std::filesystem::path& folder) const {
  StateHash hash;
  for (const auto& [part, value] : key()) hash.text(part).value(value);
  return folder / fmt::format("{:016x}.light", hash.result());
}

void TracedLight::restore(const std::filesystem::path& folder) {
  const std::optional<StateLog> log = StateLog::open(fileIn(folder), kind, key());
  if (!log) return;
  StateReader reader(log->path(), log->read(record));
  looked_ = true;
  reader.sameSize(passes_);
  reader.sameSize(seconds_);
  reader.value(lookSeconds_);
  for (std::vector<glm::dvec3>& sums : sums_) reader.sameSize(sums);
  reader.sameSize(variance_);
  reader.sameSize(firstLook_.pixels);
  for (const std::uint32_t passes : passes_) reader.require(passes > 0);
  reader.requireFinite(seconds_);
  reader.require(lookSeconds_ >= 0.0);
  for (const std::vector<glm::dvec3>& sums : sums_)
    reader.requireFinite(std::span(&sums[0].x, 3 * sums.size()));
  reader.requireFinite(std::span(&variance_[0].x, 3 * variance_.size()));
  reader.requireFinite(std::span(&firstLook_.pixels[0].x, 3 * firstLook_.pixels.size()));
}

void TracedLight::save(const std::filesystem::path& folder) const {
  StateLog log(fileIn(folder), kind, key());
  log.write(record, [&](const StateWriter::Sink& sink) {
    StateWriter writer(sink);
    writer.values(passes_);
    writer.values(seconds_);
    writer.value(lookSeconds_);
    for (const std::vector<glm::dvec3>& sums : sums_) writer.values(sums);
    writer.values(variance_);
    writer.values(firstLook_.pixels);
    writer.flush();
  });
  log.commit(0.0);
}

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

/// A block of a part, and the gain of another pass over it.
struct Candidate {
  TracedLight* part = nullptr;
  std::size_t block = 0;
  double variance = 0.0;  ///< variance of a pass of each half, summed over the block's pixels and channels

  double worth() const {
    const double n = part->passes(block);
    return variance / (n * (n + 1.0) * part->secondsOf(block));
  }
};

/// Least variance that a block is assumed to have, as a share of its part's mean: the first look misses rare
/// events.
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

/// Returns the block that gains most per second, or nullptr if no block may have more samples.
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

/// Traces passes for some seconds. Returns false if no block may have more samples.
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
  constexpr double leastTurn = 0.5, turnShare = 0.1;  // seconds between comparisons of the pictures, and
                                                      // their share of the time traced so far
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
