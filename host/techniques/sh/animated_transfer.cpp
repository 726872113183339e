#include "techniques/sh/animated_transfer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <span>

#include "basis/sh_rotation.h"
#include "scene/deform.h"
#include "techniques/sh/vertex_turns.h"

namespace prelight {

namespace {

/// Returns the rotation between two transforms of a node, the identity if the first is singular.
glm::dmat3 turnBetween(const glm::dmat4& from, const glm::dmat4& to) {
  const glm::dmat3 linear(from);
  const double size = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  if (!(std::abs(glm::determinant(linear)) > 1e-9 * size)) return glm::dmat3(1.0);
  return rotationOf(glm::dmat4(glm::dmat3(to) * glm::inverse(linear)));
}

/// Adds `weight` times the rotated transfer of vertices.
void addTurned(std::span<const float> transfer, int order, const glm::dmat3& turn, double weight,
               std::span<double> sum) {
  constexpr double negligible = 1e-12;
  if (greatestDifference(turn, glm::dmat3(1.0)) < negligible) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * double(transfer[i]);
    return;
  }
  const sh::ShRotation rotation(order, turn);
  std::vector<double> turned(transfer.begin(), transfer.end());
  rotation.apply(turned, turned);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * turned[i];
}

/// Rotations of one primitive of a scene between two poses.
class Turns {
 public:
  Turns(const Scene& scene, const MeshNode& node, std::size_t meshNode, const PrimitiveRange& range)
      : meshNode_(meshNode),
        instance_(static_cast<std::size_t>(range.instance)),
        skin_(node.skin),
        primitive_(node.skin < 0 ? nullptr
                                 : &scene.meshes[static_cast<std::size_t>(node.mesh)]
                                        .primitives[static_cast<std::size_t>(range.primitive)]) {}

  bool vertexByVertex() const { return primitive_ != nullptr; }

  /// `vertex` is a vertex of the primitive; it is ignored without a skin.
  glm::dmat3 between(const PosedTransforms& from, const PosedTransforms& to, std::size_t vertex) const {
    return turnBetween(placed(from, vertex), placed(to, vertex));
  }

 private:
  glm::dmat4 placed(const PosedTransforms& pose, std::size_t vertex) const {
    const glm::dmat4& node = pose.nodes[meshNode_][instance_];
    if (primitive_ == nullptr) return node;
    return node * blendedTransform(*primitive_, vertex, pose.joints[static_cast<std::size_t>(skin_)]);
  }

  std::size_t meshNode_, instance_;
  int skin_;
  const Primitive* primitive_;
};

}  // namespace

HarmonicTransfer mixTransfers(const PosedTransfer& first, const PosedTransfer& last, double blend,
                              const PosedTransforms& transforms, const Scene& scene,
                              const CompiledScene& compiled, KeyMix mix) {
  assert(first.transfer.coefficients.size() == last.transfer.coefficients.size());
  HarmonicTransfer result = first.transfer;
  const auto width = static_cast<std::size_t>(result.channels * result.order * result.order);
  std::map<int, std::size_t> meshNodes;
  for (std::size_t i = 0; i < scene.meshNodes.size(); ++i) meshNodes[scene.meshNodes[i].node] = i;
  std::vector<double> sum;
  for (const PrimitiveRange& range : compiled.primitives) {
    const std::size_t node = meshNodes.at(range.node), begin = range.firstVertex * width;
    const Turns turns(scene, scene.meshNodes[node], node, range);
    sum.assign(range.vertexCount * width, 0.0);
    const std::size_t part = turns.vertexByVertex() && mix == KeyMix::Turned ? width : sum.size();
    const auto add = [&](const PosedTransfer& key, double weight) {
      for (std::size_t at = 0; at < sum.size(); at += part) {
        const glm::dmat3 turn =
            mix == KeyMix::Linear ? glm::dmat3(1.0) : turns.between(key.transforms, transforms, at / width);
        addTurned(std::span(key.transfer.coefficients).subspan(begin + at, part), result.order, turn, weight,
                  std::span(sum).subspan(at, part));
      }
    };
    add(first, 1.0 - blend);
    add(last, blend);
    for (std::size_t i = 0; i < sum.size(); ++i) result.coefficients[begin + i] = static_cast<float>(sum[i]);
  }
  return result;
}

KeysAround keysAround(std::span<const double> times, double seconds) {
  const auto next = std::upper_bound(times.begin(), times.end(), seconds);
  if (next == times.begin()) return {};
  const auto key = static_cast<std::size_t>(next - times.begin()) - 1;
  if (next == times.end() || seconds == times[key]) return {key, key, 0.0};
  return {key, key + 1, (seconds - times[key]) / (times[key + 1] - times[key])};
}

HarmonicTransfer transferAt(const AnimatedTransfer& animated, const Scene& scene,
                            const CompiledScene& compiled, double seconds, KeyMix mix) {
  const KeysAround keys = keysAround(animated.times, seconds);
  if (keys.blend == 0.0) return animated.keys[keys.first];
  const auto posed = [&](std::size_t k) {
    return PosedTransfer{animated.keys[k], transformsAt(scene, animated.animation, animated.times[k])};
  };
  return mixTransfers(posed(keys.first), posed(keys.last), keys.blend,
                      transformsAt(scene, animated.animation, seconds), scene, compiled, mix);
}

}  // namespace prelight
