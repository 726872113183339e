#include <algorithm>
#include <cmath>
#include <map>

#include "scene/camera.h"
#include "scene/pose.h"
#include "viewer/follow/playback.h"
#include "viewer/web/page_parts.h"

namespace prelight::viewer {
namespace {

using Json = nlohmann::ordered_json;

constexpr double motionSamplesASecond = 60.0;
constexpr std::size_t mostMotionSamples = 3601;  ///< a minute

/// From where the inputs have a primitive to where a pose has it, in the scene's coordinates.
using Ways = std::vector<glm::dmat4>;  // [primitive]

/// The parts of a scene that move.
class Motion {
 public:
  Motion(const RenderInputs& inputs, const PlayedAnimation& animation)
      : inputs_(inputs), animation_(animation), rest_(transformsOf(inputs.scene)) {
    for (std::size_t i = 0; i < inputs.scene.meshNodes.size(); ++i)
      meshNodes_[inputs.scene.meshNodes[i].node] = i;
    const double length = animation.end - animation.start;
    const auto samples = static_cast<std::size_t>(std::ceil(length * motionSamplesASecond)) + 1;
    for (std::size_t i = 0, count = std::clamp<std::size_t>(samples, 2, mostMotionSamples); i < count; ++i)
      times_.push_back(animation.start + length * static_cast<double>(i) / static_cast<double>(count - 1));
    for (const double time : times_) poses_.push_back(waysAt(time));
    for (std::size_t p = 0; p < inputs.compiled.primitives.size(); ++p)
      if (std::any_of(poses_.begin(), poses_.end(), [&](const Ways& ways) { return moves(ways[p]); }))
        moving_.push_back(p);
  }

  bool movesAnything() const { return !moving_.empty(); }

  Json describe(PageData& data) const {
    Json ranges = Json::array();
    for (const std::size_t p : moving_) {
      const PrimitiveRange& range = inputs_.compiled.primitives[p];
      ranges.push_back({{"firstVertex", range.firstVertex},
                        {"vertexCount", range.vertexCount},
                        {"firstTriangle", range.firstTriangle},
                        {"triangleCount", range.triangleCount}});
    }
    data.addFloats("motion", std::span<const float>(rowsOf(poses_)));
    return {{"name", animation_.name},
            {"start", animation_.start},
            {"end", animation_.end},
            {"samples", times_.size()},
            {"ranges", ranges}};
  }

  /// Transfer in SH at the keys that a bake has of the animation; null without.
  Json describeKeys(PageData& data) const {
    const auto& keys = inputs_.bake->animation;
    if (!keys || keys->animation != animation_.animation) return {};
    std::vector<Ways> poses;
    for (const double time : keys->times) poses.push_back(waysAt(time));
    data.addFloats("keyMotion", std::span<const float>(rowsOf(poses)));
    Json arrays = Json::array();
    for (std::size_t k = 0; k < keys->keys.size(); ++k) {
      arrays.push_back("key" + std::to_string(k));
      data.addHalves(arrays.back(), keys->keys[k].coefficients);
    }
    const HarmonicTransfer& first = keys->keys.front();
    Json description = {
        {"times", keys->times}, {"arrays", arrays}, {"order", first.order}, {"channels", first.channels}};
    for (std::size_t k = 0; k < keys->nearLamps.size(); ++k) {
      const std::string array = "nearLamps" + std::to_string(k);
      data.addHalfBits(array, keys->nearLamps[k].halves);
      description["nearLamps"].push_back(array);
    }
    return description;
  }

  /// How far anything gets from a point.
  double reachFrom(const glm::dvec3& centre) const {
    double most = 0.0;
    for (const Ways& ways : poses_) {
      for (const std::size_t p : moving_) {
        const PrimitiveRange& range = inputs_.compiled.primitives[p];
        for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
          const glm::dvec4 rest(inputs_.compiled.positions[v], 1.0);
          most = std::max(most, glm::distance(centre, glm::dvec3(ways[p] * rest)));
        }
      }
    }
    return most;
  }

  /// [sample][light] place and direction, where lamps of the scene move.
  void addLights(Json& description, PageData& data) const {
    std::vector<ShadedLight> rest;
    for (const Light& light : inputs_.scene.lights) rest.push_back(shadedLight(light, inputs_.compiled));
    Scene posed;
    posed.nodes = inputs_.scene.nodes;
    posed.lights = inputs_.scene.lights;
    posed.animations = inputs_.scene.animations;
    posed.materials = inputs_.scene.materials;
    posed.cameras = inputs_.scene.cameras;
    std::vector<glm::vec3> places;
    bool move = false;
    for (const double time : times_) {
      setPose(posed, animation_.animation, time);
      for (std::size_t i = 0; i < posed.lights.size(); ++i) {
        const ShadedLight light = shadedLight(posed.lights[i], inputs_.compiled);
        move = move || light.position != rest[i].position || light.direction != rest[i].direction;
        places.insert(places.end(), {light.position, light.direction});
      }
    }
    if (!move) return;
    data.addFloats("lampMotion", std::span<const glm::vec3>(places));
    description["lamps"] = inputs_.scene.lights.size();
  }

  /// Messages about parts that do not move as they do in the scene.
  Json notes() const {
    Json notes = Json::array();
    const Scene& scene = inputs_.scene;
    const Animation& animation = scene.animations[animation_.animation];
    const auto bends = [](const MeshNode& node) { return node.skin >= 0 || !node.weights.empty(); };
    if (std::any_of(scene.meshNodes.begin(), scene.meshNodes.end(), bends))
      notes.push_back("meshes with skins and morph targets stay as they were baked");
    if (std::any_of(moving_.begin(), moving_.end(), [&](std::size_t p) { return glows(p); }))
      notes.push_back("the light of glowing surfaces still comes from their former places");
    if (inputs_.bake->nearLamps && inputs_.bake->animation && inputs_.bake->animation->nearLamps.empty())
      notes.push_back("lamps within the scene shine without shadows on moving parts");
    if (!animation.properties.empty()) notes.push_back("materials and lamps keep their colours");
    if (scene.animations.size() > 1)
      notes.push_back("only one of " + std::to_string(scene.animations.size()) +
                      " animations is in the page");
    return notes;
  }

 private:
  bool glows(std::size_t primitive) const {
    const CompiledScene& scene = inputs_.compiled;
    const std::uint32_t first = scene.primitives[primitive].firstTriangle;
    return first < scene.triangleCount() &&
           scene.materials[scene.triangleMaterials[first]].emission != glm::vec3(0.0f);
  }

  static bool moves(const glm::dmat4& way) {
    const glm::dmat4 away = way - glm::dmat4(1.0);
    double most = 0.0;
    for (int column = 0; column < 4; ++column) most = std::max(most, glm::dot(away[column], away[column]));
    return most > 1e-18;
  }

  /// Primitives that a skin bends, or that were flat, stay.
  Ways waysAt(double time) const {
    const PosedTransforms pose = transformsAt(inputs_.scene, animation_.animation, time);
    const glm::dmat4 here = translationOf(inputs_.compiled.origin),
                     back = translationOf(-inputs_.compiled.origin);
    Ways ways;
    for (const PrimitiveRange& range : inputs_.compiled.primitives) {
      const std::size_t node = meshNodes_.at(range.node);
      const auto instance = static_cast<std::size_t>(range.instance);
      const glm::dmat4& from = rest_.nodes[node][instance];
      const bool stays = inputs_.scene.meshNodes[node].skin >= 0 || std::abs(glm::determinant(from)) < 1e-12;
      ways.push_back(stays ? glm::dmat4(1.0) : back * pose.nodes[node][instance] * glm::inverse(from) * here);
    }
    return ways;
  }

  static glm::dmat4 translationOf(const glm::dvec3& by) {
    glm::dmat4 m(1.0);
    m[3] = glm::dvec4(by, 1.0);
    return m;
  }

  /// [pose][moving primitive][column 0..3][row 0..2]
  std::vector<float> rowsOf(const std::vector<Ways>& poses) const {
    std::vector<float> rows;
    for (const Ways& ways : poses)
      for (const std::size_t p : moving_)
        for (int column = 0; column < 4; ++column)
          for (int row = 0; row < 3; ++row) rows.push_back(static_cast<float>(ways[p][column][row]));
    return rows;
  }

  const RenderInputs& inputs_;
  const PlayedAnimation& animation_;
  PosedTransforms rest_;
  std::map<int, std::size_t> meshNodes_;
  std::vector<double> times_;
  std::vector<Ways> poses_;
  std::vector<std::size_t> moving_;
};

}  // namespace

void addMotion(const RenderInputs& inputs, PageScene& page) {
  Playback playback(inputs.scene);
  if (inputs.bake->animation) playback.chooseAnimation(inputs.bake->animation->animation);
  if (!playback.exists()) return;
  const Motion motion(inputs, playback.animations()[playback.chosen()]);
  if (!motion.movesAnything()) return;
  const std::size_t before = page.data.bytes().size();
  Json description = motion.describe(page.data);
  description["keys"] = motion.describeKeys(page.data);
  motion.addLights(description, page.data);
  description["notes"] = motion.notes();
  description["bytes"] = page.data.bytes().size() - before;
  Json& sphere = page.description["sphere"];
  const Json& c = sphere["centre"];
  const glm::dvec3 centre(c[0].get<double>(), c[1].get<double>(), c[2].get<double>());
  sphere["reach"] = std::max(sphere["reach"].get<double>(), sphereSlack * motion.reachFrom(centre));
  page.description["motion"] = description;
}

}  // namespace prelight::viewer
