#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace prelight {

enum class AnimatedPath : std::uint8_t { Translation, Rotation, Scale };

enum class Interpolation : std::uint8_t { Linear, Step, CubicSpline };

/// Values over time, as a glTF animation sampler gives them.
struct AnimationSampler {
  Interpolation interpolation = Interpolation::Linear;
  std::vector<float> times;  ///< [key], seconds, >= 0, strictly ascending, never empty
  /// [key], or [key][in-tangent, value, out-tangent] with cubic splines. x, y, z of translations and scales,
  /// x, y, z, w of rotations. Finite.
  std::vector<glm::vec4> values;
};

struct AnimationChannel {
  std::size_t node = 0;  ///< into Scene::nodes
  AnimatedPath path = AnimatedPath::Translation;
  std::size_t sampler = 0;  ///< into Animation::samplers
};

/// A glTF animation, as far as it moves nodes of the scene.
struct Animation {
  std::string name;
  std::vector<AnimationSampler> samplers;
  std::vector<AnimationChannel> channels;

  /// Seconds of the first and the last key of all channels; 0 without channels.
  double startTime() const;
  double endTime() const;
};

/// Value of a sampler at a time; before the first key and after the last theirs. Rotations are unit
/// quaternions, linear ones taken the short way round (glTF 2.0, appendix C); one of length 0 is none.
glm::dvec4 sampleAt(const AnimationSampler& sampler, AnimatedPath path, double seconds);

}  // namespace prelight
