#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "prelight/transfer.h"
#include "scene/pose.h"

namespace prelight {

/// How transfer between two keys is made of them.
enum class KeyMix : std::uint8_t {
  Linear,  ///< coefficients in world space, mixed linearly
  Turned,  ///< first turned with the node, or the joints, from where it was at the key, then mixed linearly
};

/// A key of an animation and the transforms of mesh nodes and skins then.
struct PosedTransfer {
  const HarmonicTransfer& transfer;
  PosedTransforms transforms;
};

/// The rotation nearest to the linear part of an affine map: the factor of its polar decomposition. The
/// identity when the map flattens or mirrors.
glm::dmat3 rotationOf(const glm::dmat4& map);

/// (1 - blend) first + blend last, both of one shape, for the transforms at the moment between. `compiled` is
/// the scene flattened in any pose. What a skin bends turns vertex by vertex.
HarmonicTransfer mixTransfers(const PosedTransfer& first, const PosedTransfer& last, double blend,
                              const PosedTransforms& transforms, const Scene& scene,
                              const CompiledScene& compiled, KeyMix mix);

/// Transfer at a moment of the animation, from the two keys around it; before the first key and after the
/// last it is theirs, and at a key exactly the key's. `scene` and `compiled` may be in any pose.
HarmonicTransfer transferAt(const AnimatedTransfer& animated, const Scene& scene,
                            const CompiledScene& compiled, double seconds, KeyMix mix = KeyMix::Turned);

}  // namespace prelight
