#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "prelight/transfer.h"
#include "scene/pose.h"

namespace prelight {

/// How transfer between two keys is interpolated.
enum class KeyMix : std::uint8_t {
  Linear,  ///< coefficients in world space, mixed linearly
  Turned,  ///< rotated with the node, or the joints, from the pose of the key, then mixed linearly
};

/// A key of an animation with the transforms of mesh nodes and skins at its time.
struct PosedTransfer {
  const HarmonicTransfer& transfer;
  PosedTransforms transforms;
};

/// Returns (1 - blend) first + blend last, both of equal shape, for the given transforms of the moment
/// between them. `compiled` is the scene in any pose. Skinned vertices are rotated individually.
HarmonicTransfer mixTransfers(const PosedTransfer& first, const PosedTransfer& last, double blend,
                              const PosedTransforms& transforms, const Scene& scene,
                              const CompiledScene& compiled, KeyMix mix);

/// The keys between which a moment lies.
struct KeysAround {
  std::size_t first = 0, last = 0;
  double blend = 0.0;  ///< share of the last key; 0 at the first one, and before and after all keys
};

KeysAround keysAround(std::span<const double> times, double seconds);

/// Returns the transfer at a moment of the animation, interpolated between the two surrounding keys, clamped
/// to the first and last one, and exact at keys. `scene` and `compiled` may be in any pose.
HarmonicTransfer transferAt(const AnimatedTransfer& animated, const Scene& scene,
                            const CompiledScene& compiled, double seconds, KeyMix mix = KeyMix::Turned);

}  // namespace prelight
