#include "integrators/exposure.h"

#include <cmath>

#include "base/state_file.h"
#include "prelight/error.h"
#include "scene/pose.h"

namespace prelight::reference {

double momentOfPass(std::uint64_t pass, std::uint64_t seed) {
  double inverse = 0.0, digit = 0.5;
  for (; pass > 0; pass >>= 1, digit *= 0.5)
    if ((pass & 1) != 0) inverse += digit;  // van der Corput 1935
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;
  const double shift = std::ldexp(static_cast<double>(((seed + 1) * golden) >> 11), -53);
  const double moment = inverse + shift;
  return moment < 1.0 ? moment : moment - 1.0;
}

Exposure::Exposure(const Scene& scene, const ReferenceInputs& opened, const StillParts& still,
                   const ReferenceRequest& request)
    : opened_(opened),
      still_(still),
      from_(scene.moment.value_or(SceneMoment{})),
      shutter_(request.shutter),
      seed_(request.seed),
      posed_(scene) {}

const ReferenceInputs& Exposure::ofPass(std::uint64_t pass) {
  setPose(posed_, from_.animation, from_.seconds + shutter_ * momentOfPass(pass, seed_));
  Warnings said;  // these warnings were given for the moment in which the shutter opened
  compiled_ = compileScene(posed_, said);
  now_.emplace(ReferenceInputs{compiled_, opened_.images, still_.lights ? opened_.lights : posed_.lights,
                               still_.camera ? posed_.cameras[*still_.camera] : opened_.camera, opened_.sky,
                               opened_.skyRotation});
  return *now_;
}

std::uint64_t Exposure::motion() const {
  StateHash hash;
  hash.value(from_.animation).value(from_.seconds);
  const Animation& animation = posed_.animations.at(from_.animation);
  for (const AnimationSampler& sampler : animation.samplers)
    hash.value(static_cast<int>(sampler.interpolation))
        .values(sampler.times)
        .values(sampler.values)
        .values(sampler.weights)
        .value(sampler.targets);
  hash.value(animation.channels.size());
  for (const AnimationChannel& channel : animation.channels)
    hash.value(channel.node).value(static_cast<int>(channel.path)).value(channel.sampler);
  for (const PropertyChannel& channel : animation.properties)
    hash.value(static_cast<int>(channel.property))
        .value(channel.object)
        .value(channel.sampler)
        .values(std::vector{channel.rest, channel.factor})
        .value(channel.factorSampler);
  return hash.result();
}

}  // namespace prelight::reference
