#include "prelight/relighter.h"

#include <fmt/format.h>

#include <algorithm>

#include "basis/sh_evaluate.h"
#include "device/context.h"
#include "library/relit_choice.h"
#include "prelight/error.h"
#include "relight/device/harmonic_light.h"
#include "relight/device/light_projector.h"

namespace prelight {

struct DeviceColors::State {
  Buffer<float> values;  ///< [receiver][3]
  std::size_t size = 0;
};

DeviceColors::DeviceColors(std::shared_ptr<State> state) : state_(std::move(state)) {}

std::size_t DeviceColors::size() const { return state_->size; }

void DeviceColors::read(std::span<glm::vec3> colors) const {
  if (colors.size() != size())
    throw UsageError("radiance", fmt::format("got room for {} colours, expected {}", colors.size(), size()));
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  if (!colors.empty()) state_->values.read(std::span<float>(&colors.front().x, 3 * colors.size()));
}

void* DeviceColors::openclBuffer() const { return state_->values.memory()->handle(); }

struct Relighter::State {
  RelitChoice choice;
  std::unique_ptr<RelitPart> part;
  std::vector<std::unique_ptr<RelitPart>> added;  ///< light of other transfer at the same vertices
  std::shared_ptr<DeviceColors::State> colors;
  DeviceColors shown;

  explicit State(const RelitSource& source)
      : choice(chooseTransfer(source.bake, source.options.technique)),
        part(choice.relighting->make(source)),
        colors(std::make_shared<DeviceColors::State>()),
        shown(colors) {
    colors->size = part->receiverCount();
    colors->values = Buffer<float>(source.device, 3 * colors->size);
    if (choice.relighting->atVertices) added = makeAddedParts(source);
    light({});
  }

  void light(const RelighterLight& light) {
    checkRelighterLight(light);
    if (!light.groups.empty()) checkGroups(light.groups.size());  // before any part takes the light
    part->light(light);
    for (const auto& one : added) one->light(light);
  }

  void checkGroups(std::size_t given) const {
    std::size_t count = part->groupCount();
    for (const auto& one : added) count = std::max(count, one->groupCount());
    if (count == 0)
      throw UsageError("RelighterLight::groups",
                       fmt::format("{} comes without the scene's own lights", choice.technique),
                       "bake both, and choose transfer at vertices");
    if (given != count)
      throw UsageError("RelighterLight::groups",
                       fmt::format("got {} colours, expected one per group: {}", given, count));
  }

  void relight() {
    if (colors->size == 0) return;
    part->relight(colors->values);
    for (const auto& one : added) one->relight(colors->values);
  }
};

Relighter::Relighter(const Bake& bake, const Device& device, const RelighterOptions& options)
    : state_(std::make_unique<State>(RelitSource{bake, options, device.context()})) {}

Relighter::Relighter(Relighter&&) noexcept = default;
Relighter& Relighter::operator=(Relighter&&) noexcept = default;
Relighter::~Relighter() = default;

const std::string& Relighter::technique() const { return state_->choice.technique; }

const std::string& Relighter::reason() const { return state_->choice.reason; }

std::size_t Relighter::receiverCount() const { return state_->colors->size; }

std::size_t Relighter::bytesMoved() const {
  std::size_t bytes = state_->part->bytesMoved();
  for (const auto& one : state_->added) bytes += one->bytesMoved();
  return bytes;
}

void Relighter::light(const RelighterLight& light) { state_->light(light); }

void Relighter::setTime(double seconds) { state_->part->setTime(seconds); }

const DeviceColors& Relighter::relight() {
  state_->relight();
  return state_->shown;
}

void Relighter::relight(std::span<glm::vec3> radiance) { relight().read(radiance); }

struct SkyProjector::State {
  LightProjector projector;
};

SkyProjector::SkyProjector(const Device& device, int width, int height, int order) {
  sh::checkOrder(order, "SkyProjector: order");
  if (width < 1 || height < 1)
    throw UsageError("SkyProjector: size",
                     fmt::format("got {} x {} texels, expected at least one", width, height));
  state_ = std::make_unique<State>(State{LightProjector(device.context(), width, height, order)});
}

SkyProjector::SkyProjector(SkyProjector&&) noexcept = default;
SkyProjector& SkyProjector::operator=(SkyProjector&&) noexcept = default;
SkyProjector::~SkyProjector() = default;

void SkyProjector::setSky(const Environment& sky) { state_->projector.setSky(sky); }

void SkyProjector::setRotation(const glm::dmat3& rotation) { state_->projector.setRotation(rotation); }

std::vector<double> SkyProjector::projectSh() {
  const std::vector<float> coefficients = state_->projector.projectSh();
  return {coefficients.begin(), coefficients.end()};
}

std::vector<float> SkyProjector::projectWavelets(int faceSize, int samples) {
  constexpr int mostSamples = 64;
  if (samples < 1 || samples > mostSamples)
    throw UsageError("SkyProjector: samples", fmt::format("got {}, expected 1 to {}", samples, mostSamples));
  return state_->projector.projectWavelets(faceSize, samples);
}

}  // namespace prelight
