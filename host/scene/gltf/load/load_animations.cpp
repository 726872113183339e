#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "prelight/error.h"
#include "scene/animation.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/load/load_parts.h"

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
    if (!std::isfinite(times[i]))
      input.fail(fmt::format("time {} is {}, expected finite seconds", i, times[i]),
                 "export the animation again");
    if (i > 0 && times[i] <= times[i - 1])
      input.fail(
          fmt::format("time {} is {} after {}, expected strictly ascending times", i, times[i], times[i - 1]),
          "export the animation again");
  }
  return times;
}

/// The type of a sampler's values: vectors of 1 to 4 numbers, or one number per morph target.
struct ValueShape {
  std::size_t numbers = 3;
  std::size_t targets = 0;  ///< 0 for vectors
  bool integers = false;    ///< may be integers
  bool shares = false;      ///< integers are normalised even if the file does not say so
  bool rotation = false;
  auto operator<=>(const ValueShape&) const = default;
};

const char* typeOf(const ValueShape& shape) {
  constexpr std::array<const char*, 4> types = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return types[shape.targets > 0 ? 0 : shape.numbers - 1];
}

/// Reads `expected` values of a shape, all finite.
std::vector<float> readNumbers(const LoadContext& context, const JsonCursor& output, const ValueShape& shape,
                               std::size_t expected) {
  const AccessorReader reader = openAccessor(context, output);
  const char* type = typeOf(shape);
  if (reader.type() != type)
    output.fail(fmt::format("expected values of type {}, got {}", type, reader.type()));
  if (reader.componentType() != float32 &&
      (!shape.integers || (shape.shares && reader.componentType() == 5125)))
    output.fail(fmt::format("expected values of component type {}{}, got {}", float32,
                            shape.shares     ? " or normalised integers"
                            : shape.integers ? " or integers"
                                             : "",
                            reader.componentType()));
  const std::size_t count = expected * std::max<std::size_t>(shape.targets, 1);
  if (reader.count() != count)
    output.fail(fmt::format(
        "{} values, expected {}: {}one for each time, or three with CUBICSPLINE", reader.count(), count,
        shape.targets > 0 ? fmt::format("for each of {} morph targets, ", shape.targets) : ""));
  std::vector<float> numbers = reader.floats(shape.shares && reader.componentType() != float32);
  const auto bad = std::find_if(numbers.begin(), numbers.end(), [](float v) { return !std::isfinite(v); });
  if (bad != numbers.end())
    output.fail(fmt::format("number {} is {}, expected finite ones", bad - numbers.begin(), *bad));
  return numbers;
}

/// Pads values to vectors of four. A single number becomes all four components, so that it can multiply
/// others.
std::vector<glm::vec4> asVectorsOfFour(const std::vector<float>& numbers, std::size_t width) {
  std::vector<glm::vec4> values(numbers.size() / width, glm::vec4(0.0f));
  for (std::size_t i = 0; i < numbers.size(); ++i)
    values[i / width][static_cast<int>(i % width)] = numbers[i];
  if (width == 1)
    for (glm::vec4& value : values) value = glm::vec4(value.x);
  return values;
}

const char* nameOfPath(AnimatedPath path) {
  constexpr std::array<const char*, 4> names = {"translation", "rotation", "scale", "weights"};
  return names[static_cast<std::size_t>(path)];
}

/// The objects to which a file's channels refer.
struct AnimatedPlaces {
  std::map<std::size_t, std::size_t> nodes;  ///< index into Scene::nodes, by node of the file
  std::vector<std::size_t> targets;          ///< [node of the scene] number of morph targets of its mesh
  PointerFinder pointers;
};

/// Reads an animation channel by channel; samplers that several channels share are read once per kind of
/// value.
class AnimationLoader {
 public:
  AnimationLoader(const LoadContext& context, const JsonCursor& json, Scene& scene,
                  const AnimatedPlaces& places)
      : context_(context), json_(json), scene_(scene), places_(places) {}

  Animation load() {
    animation_.name = json_.stringOr("name", "");
    json_.forEachObject("channels", [&](const JsonCursor& channel, std::size_t) { addChannel(channel); });
    return std::move(animation_);
  }

 private:
  void warn(const JsonCursor& json, const std::string& what) const {
    context_.warnings.push_back(json.where() + ": " + what);
  }

  void rests(const JsonCursor& json, const std::string& name) {
    // There is one warning per name, however many channels there are.
    if (unsupported_.insert(name).second) warn(json, fmt::format("\"{}\" is not animated, it rests", name));
  }

  void addChannel(const JsonCursor& channel) {
    const JsonCursor target = channel.at("target");
    const std::string pathName = target.at("path").asString();
    const auto pointing = LoadContext::extension(target, "KHR_animation_pointer");
    if (pathName == "pointer" && pointing) return addPointer(channel, pointing->at("pointer"));
    const std::optional<AnimatedPath> path = animatedPath(pathName);
    if (!path) return rests(target, pathName);
    // Without a node, an extension that is not supported determines what moves.
    const auto node = target.find("node");
    if (node) addNode(channel, target, node->asIndex(context_.root.countOf("nodes"), "node"), *path);
  }

  void addNode(const JsonCursor& channel, const JsonCursor& target, std::size_t index, AnimatedPath path) {
    const auto place = places_.nodes.find(index);
    if (place == places_.nodes.end()) return;
    if (path != AnimatedPath::Weights && context_.root.at("nodes").at(index).find("matrix")) {
      warn(target, fmt::format("node {} has a matrix, which cannot be animated; it rests", index));
      return;
    }
    ValueShape shape{.numbers = path == AnimatedPath::Rotation ? std::size_t{4} : std::size_t{3},
                     .integers = path == AnimatedPath::Rotation,
                     .shares = path == AnimatedPath::Rotation,
                     .rotation = path == AnimatedPath::Rotation};
    if (path == AnimatedPath::Weights) {
      shape = {.numbers = 1, .targets = places_.targets[place->second], .integers = true, .shares = true};
      if (shape.targets == 0) {
        warn(target, fmt::format("node {} has no mesh with morph targets; its weights are left out", index));
        return;
      }
    }
    if (!hasTimes(channel)) {
      warn(channel, "its times have no data; it rests");
      return;
    }
    if (!targets_.insert({index, path}).second)
      channel.fail(fmt::format("the {} of node {} is animated twice", nameOfPath(path), index),
                   "export the animation again");
    animation_.channels.push_back({place->second, path, samplerOf(channel, shape)});
  }

  void addPointer(const JsonCursor& channel, const JsonCursor& pointer) {
    const std::optional<AnimationTarget> target = places_.pointers.find(pointer);
    if (!target) return rests(pointer, pointer.asString());
    if (target->path) return addNode(channel, pointer, target->node, *target->path);
    if (target->objects.empty()) return;
    if (!hasTimes(channel)) {
      warn(channel, "its times have no data; it rests");
      return;
    }
    if (!pointers_.insert(target->text).second)
      channel.fail(fmt::format("\"{}\" is animated twice", target->text), "export the animation again");
    const std::size_t numbers = target->isFactor ? 1 : static_cast<std::size_t>(numbersOf(*target->property));
    const std::size_t sampler = samplerOf(channel, {.numbers = numbers, .integers = true});
    for (const std::size_t object : target->objects) addProperty(*target, object, sampler);
  }

  /// A vector and the number that multiplies it are one property, whichever is animated.
  void addProperty(const AnimationTarget& target, std::size_t object, std::size_t sampler) {
    const auto [known, fresh] =
        properties_.try_emplace({*target.property, object}, animation_.properties.size());
    if (!fresh) {
      animation_.properties[known->second].factorSampler = static_cast<int>(sampler);
      return;
    }
    PropertyChannel channel;
    channel.property = *target.property;
    channel.object = object;
    channel.sampler = sampler;
    channel.rest = propertyOf(scene_, *target.property, object);
    channel.factor = target.other;
    animation_.properties.push_back(channel);
  }

  std::size_t indexOfSampler(const JsonCursor& channel) const {
    return channel.at("sampler").asIndex(json_.at("samplers").arraySize(), "sampler");
  }

  /// Returns true when a channel has key times. A single time of 0 needs no data.
  bool hasTimes(const JsonCursor& channel) const {
    const JsonCursor sampler = json_.at("samplers").at(indexOfSampler(channel));
    const AccessorReader times = openAccessor(context_, sampler.at("input"));
    return times.count() == 1 || times.hasData();
  }

  std::size_t samplerOf(const JsonCursor& channel, const ValueShape& shape) {
    const JsonCursor samplers = json_.at("samplers");
    const std::size_t index = indexOfSampler(channel);
    const auto known = samplers_.find({index, shape});
    if (known != samplers_.end()) return known->second;
    const JsonCursor json = samplers.at(index);
    AnimationSampler sampler;
    sampler.interpolation = interpolationOf(json);
    sampler.times = readTimes(context_, json.at("input"));
    if (!sampler.times.empty() && sampler.times.front() < 0.0f && !startsEarly_) {
      warn(json.at("input"),
           fmt::format("time 0 is {}, expected seconds >= 0; the animation starts at 0, within its keys",
                       sampler.times.front()));
      startsEarly_ = true;
    }
    const std::size_t parts = sampler.interpolation == Interpolation::CubicSpline ? 3 : 1;
    std::vector<float> numbers =
        readNumbers(context_, json.at("output"), shape, parts * sampler.times.size());
    sampler.targets = shape.targets;
    if (shape.targets > 0)
      sampler.weights = std::move(numbers);
    else
      sampler.values = asVectorsOfFour(numbers, shape.numbers);
    if (shape.rotation) warnAboutNoRotation(json, sampler, parts);
    animation_.samplers.push_back(std::move(sampler));
    return samplers_[{index, shape}] = animation_.samplers.size() - 1;
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
  Scene& scene_;
  const AnimatedPlaces& places_;
  Animation animation_;
  bool startsEarly_ = false;
  std::map<std::pair<AnimatedProperty, std::size_t>, std::size_t> properties_;  ///< by property and object
  std::set<std::string> unsupported_;
  std::set<std::string> pointers_;
  std::set<std::pair<std::size_t, AnimatedPath>> targets_;
  std::map<std::pair<std::size_t, ValueShape>, std::size_t> samplers_;
};

}  // namespace

std::vector<Animation> loadAnimations(const LoadContext& context, Scene& scene) {
  std::vector<Animation> animations;
  if (context.root.countOf("animations") == 0) return animations;
  AnimatedPlaces places{{}, std::vector<std::size_t>(scene.nodes.size(), 0), PointerFinder(context, scene)};
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    places.nodes[static_cast<std::size_t>(scene.nodes[i].node)] = i;
  for (const MeshNode& node : scene.meshNodes) places.targets[node.sceneNode] = node.restWeights.size();
  context.root.forEachObject("animations", [&](const JsonCursor& json, std::size_t) {
    animations.push_back(AnimationLoader(context, json, scene, places).load());
  });
  return animations;
}

}  // namespace prelight
