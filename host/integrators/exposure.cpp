#include "integrators/exposure.h"

#include <cmath>

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

}  // namespace prelight::reference
