#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "prelight/error.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/load_parts.h"

namespace prelight {

namespace {

constexpr int float32 = 5126;

Interpolation interpolationOf(const JsonCursor& sampler) {
  const auto json = sampler.find("interpolation");
  if (!json || json->asString() == "LINEAR") return Interpolation::Linear;
  if (json->asString() == "STEP") return Interpolation::Step;
  if (json->asString() == "CUBICSPLINE") return Interpolation::CubicSpline;
  json->fail(fmt::format("expected LINEAR, STEP or CUBICSPLINE, got \"{}\"", json->asString()));
}

AccessorReader openAccessor(const LoadContext& context, const JsonCursor& reference) {
  return {context.document, reference.asIndex(context.root.countOf("accessors"), "accessor")};
}

std::vector<float> readTimes(const LoadContext& context, const JsonCursor& input) {
  const AccessorReader reader = openAccessor(context, input);
  if (reader.type() != "SCALAR" || reader.componentType() != float32)
    input.fail(fmt::format("expected times of type SCALAR and component type {}, got {} and {}", float32,
                           reader.type(), reader.componentType()));
  std::vector<float> times = reader.floats();
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || times[i] < 0.0f)
      input.fail(fmt::format("time {} is {}, expected finite seconds >= 0", i, times[i]),
                 "export the animation again");
    if (i > 0 && times[i] <= times[i - 1])
      input.fail(
          fmt::format("time {} is {} after {}, expected strictly ascending times", i, times[i], times[i - 1]),
          "export the animation again");
  }
  return times;
}

/// Values as vectors of four. Rotations may be stored as normalised integers, others are floats.
std::vector<glm::vec4> readValues(const LoadContext& context, const JsonCursor& output, bool rotation,
                                  std::size_t expected) {
  const AccessorReader reader = openAccessor(context, output);
  const char* type = rotation ? "VEC4" : "VEC3";
  if (reader.type() != type)
    output.fail(fmt::format("expected values of type {}, got {}", type, reader.type()));
  if (reader.componentType() != float32 && (!rotation || reader.componentType() == 5125))
    output.fail(fmt::format("expected values of component type {}{}, got {}", float32,
                            rotation ? " or normalised integers" : "", reader.componentType()));
  if (reader.count() != expected)
    output.fail(fmt::format("{} values, expected {}: one for each time, or three with CUBICSPLINE",
                            reader.count(), expected));
  const std::vector<float> numbers = reader.floats(rotation && reader.componentType() != float32);
  const auto bad = std::find_if(numbers.begin(), numbers.end(), [](float v) { return !std::isfinite(v); });
  if (bad != numbers.end())
    output.fail(fmt::format("number {} is {}, expected finite ones", bad - numbers.begin(), *bad));
  std::vector<glm::vec4> values(expected, glm::vec4(0.0f));
  const std::size_t width = reader.components();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    values[i / width][static_cast<int>(i % width)] = numbers[i];
  return values;
}

std::optional<AnimatedPath> pathOf(const std::string& path) {
  if (path == "translation") return AnimatedPath::Translation;
  if (path == "rotation") return AnimatedPath::Rotation;
  if (path == "scale") return AnimatedPath::Scale;
  return std::nullopt;
}

/// Reads an animation channel by channel; samplers that several share are read once for each kind of value.
class AnimationLoader {
 public:
  AnimationLoader(const LoadContext& context, const JsonCursor& json,
                  const std::map<std::size_t, std::size_t>& places)
      : context_(context), json_(json), places_(places) {}

  Animation load() {
    animation_.name = json_.stringOr("name", "");
    json_.forEachObject("channels", [&](const JsonCursor& channel, std::size_t) { addChannel(channel); });
    return std::move(animation_);
  }

 private:
  void warn(const JsonCursor& json, const std::string& what) const {
    context_.warnings.push_back(json.where() + ": " + what);
  }

  void addChannel(const JsonCursor& channel) {
    const JsonCursor target = channel.at("target");
    const std::string& pathName = target.at("path").asString();
    const std::optional<AnimatedPath> path = pathOf(pathName);
    if (!path) {
      // One warning tells it, however many channels there are.
      if (unsupported_.insert(pathName).second)
        warn(target, fmt::format("\"{}\" is not animated, it rests", pathName));
      return;
    }
    // Without a node an extension that is not supported would say what moves.
    const auto node = target.find("node");
    if (!node) return;
    const std::size_t index = node->asIndex(context_.root.countOf("nodes"), "node");
    const auto place = places_.find(index);
    if (place == places_.end()) return;
    if (context_.root.at("nodes").at(index).find("matrix")) {
      warn(target, fmt::format("node {} has a matrix, which cannot be animated; it rests", index));
      return;
    }
    if (!hasTimes(channel)) {
      warn(channel, "its times have no data; it rests");
      return;
    }
    if (!targets_.insert({index, *path}).second)
      channel.fail(fmt::format("the {} of node {} is animated twice", pathName, index),
                   "export the animation again");
    animation_.channels.push_back({place->second, *path, samplerOf(channel, *path)});
  }

  std::size_t indexOfSampler(const JsonCursor& channel) const {
    return channel.at("sampler").asIndex(json_.at("samplers").arraySize(), "sampler");
  }

  /// A single time of 0 needs none.
  bool hasTimes(const JsonCursor& channel) const {
    const JsonCursor sampler = json_.at("samplers").at(indexOfSampler(channel));
    const AccessorReader times = openAccessor(context_, sampler.at("input"));
    return times.count() == 1 || times.hasData();
  }

  std::size_t samplerOf(const JsonCursor& channel, AnimatedPath path) {
    const JsonCursor samplers = json_.at("samplers");
    const std::size_t index = indexOfSampler(channel);
    const bool rotation = path == AnimatedPath::Rotation;
    const auto known = samplers_.find({index, rotation});
    if (known != samplers_.end()) return known->second;
    const JsonCursor json = samplers.at(index);
    AnimationSampler sampler;
    sampler.interpolation = interpolationOf(json);
    sampler.times = readTimes(context_, json.at("input"));
    const std::size_t parts = sampler.interpolation == Interpolation::CubicSpline ? 3 : 1;
    sampler.values = readValues(context_, json.at("output"), rotation, parts * sampler.times.size());
    if (rotation) warnAboutNoRotation(json, sampler, parts);
    animation_.samplers.push_back(std::move(sampler));
    return samplers_[{index, rotation}] = animation_.samplers.size() - 1;
  }

  void warnAboutNoRotation(const JsonCursor& json, const AnimationSampler& sampler, std::size_t parts) const {
    for (std::size_t i = parts / 2; i < sampler.values.size(); i += parts) {
      if (sampler.values[i] != glm::vec4(0.0f)) continue;
      warn(json, fmt::format("rotation {} is of length 0 and is taken as none", i / parts));
      return;
    }
  }

  const LoadContext& context_;
  const JsonCursor& json_;
  const std::map<std::size_t, std::size_t>& places_;
  Animation animation_;
  std::set<std::string> unsupported_;
  std::set<std::pair<std::size_t, AnimatedPath>> targets_;
  std::map<std::pair<std::size_t, bool>, std::size_t> samplers_;
};

}  // namespace

std::vector<Animation> loadAnimations(const LoadContext& context, const std::vector<SceneNode>& nodes) {
  std::map<std::size_t, std::size_t> places;
  for (std::size_t i = 0; i < nodes.size(); ++i) places[static_cast<std::size_t>(nodes[i].node)] = i;
  std::vector<Animation> animations;
  context.root.forEachObject("animations", [&](const JsonCursor& json, std::size_t) {
    animations.push_back(AnimationLoader(context, json, places).load());
  });
  return animations;
}

}  // namespace prelight
