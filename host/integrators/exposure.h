#pragma once

#include <cstdint>
#include <optional>

#include "integrators/reference.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::reference {

/// Returns the share in [0,1) of a shutter's time at which a pass looks. Any number of first passes divides
/// the time evenly; the seed shifts all.
double momentOfPass(std::uint64_t pass, std::uint64_t seed);

/// The parts of a picture that do not move with its scene's animation.
struct StillParts {
  bool lights = false;  ///< punctual lights were given beside the scene
  std::optional<std::size_t>
      camera;  ///< index of the scene's camera that is looked through; none: a still one
};

/// A scene that its animation moves while a shutter is open. Each pass shows one moment, for which the scene
/// is flattened anew.
class Exposure {
 public:
  /// `scene` is in the pose of Scene::moment, in which the shutter opens, and `opened` are the inputs of that
  /// moment. Both must outlive this.
  Exposure(const Scene& scene, const ReferenceInputs& opened, const StillParts& still,
           const ReferenceRequest& request);

  /// Returns the inputs of a pass; they hold until the next call.
  const ReferenceInputs& ofPass(std::uint64_t pass);

  /// Returns a hash of the animation and of the moment in which the shutter opens.
  std::uint64_t motion() const;

 private:
  const ReferenceInputs& opened_;
  StillParts still_;
  SceneMoment from_;
  double shutter_;
  std::uint64_t seed_;
  Scene posed_;
  CompiledScene compiled_;
  std::optional<ReferenceInputs> now_;
};

}  // namespace prelight::reference
