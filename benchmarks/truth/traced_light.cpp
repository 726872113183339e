#include "benchmarks/truth/traced_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/state_log.h"
#include "benchmarks/run/measure.h"
#include "integrators/reference.h"

namespace prelight::benchmarks {

namespace {

/// Samples of a pixel that are one sequence: the more, the better they spread.
constexpr std::uint64_t samplesOfPass = 256;
constexpr std::uint64_t samplesOfLook = 64;
constexpr std::size_t mostBlockPixels = 256;  // enough paths for a launch, few enough to differ in variance
constexpr std::uint64_t seedOfLook = 1;       // samples follow another
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

/// Two passes; half of their squared difference is the variance of one.
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

/// Light of another scene has a file of another name.
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

}  // namespace prelight::benchmarks
