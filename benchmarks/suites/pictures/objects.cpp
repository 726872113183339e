#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "benchmarks/run/timing.h"
#include "benchmarks/suites/pictures/pictures_suite.h"
#include "benchmarks/suites/pictures/sky_pictures.h"
#include "benchmarks/truth/seen_places.h"
#include "relight/object_light.h"
#include "relight/shadowed_transfer.h"
#include "scene/append_object.h"
#include "scene/builtin/mesh_shapes.h"
#include "viewer/frame/render.h"
#include "viewer/gl/egl_context.h"

namespace prelight::benchmarks {

namespace {

constexpr int objectSkyRows = 64, objectOwnBounces = 2, objectOrder = Neighbourhood::mostOrder;
constexpr double seenRadii = 3.5;    ///< radii of an object within which its shadow is compared
constexpr double stepOfMove = 0.05;  ///< m
constexpr std::uint64_t firstTruthSeed = 101, secondTruthSeed = 102;

/// The place of an object of 1 m, and the light of the scene.
struct Stage {
  const char* scene;
  glm::dvec3 place;
  bool hasSky;
  int bounces;
};

constexpr Stage stages[] = {{"shapes", {0.3, 0.6, 0.0}, true, 1}, {"rooms", {-1.9, 0.7, 0.3}, false, 4}};

enum class Way { None, Rays, Occluders, Neighbourhood };
struct NamedWay {
  Way way;
  const char* name;
};
constexpr NamedWay ways[] = {{Way::None, "no shadow"},
                             {Way::Rays, "rays"},
                             {Way::Occluders, "occluders"},
                             {Way::Neighbourhood, "neighbourhood"}};

Scene sceneOfShape(const MeshShape& shape) {
  Scene scene;
  Primitive primitive;
  primitive.positions = shape.positions;
  primitive.normals = shape.normals;
  primitive.triangles = shape.triangles;
  primitive.material = 0;
  scene.meshes.push_back({"Object", {primitive}});
  Material& material = scene.materials.emplace_back();
  material.baseColor = {0.8f, 0.5f, 0.2f, 1.0f};
  material.metallic = material.specular = 0.0f;
  scene.nodes.emplace_back();
  scene.meshNodes.emplace_back().transforms.emplace_back(1.0);
  return scene;
}

Scene modelOf(const std::string& name) {
  if (name == "ring") return sceneOfShape(makeTorus(0.35f, 0.15f, 36, 18));
  if (name == "plate") return sceneOfShape(makeBox({1.0, 0.05, 0.7}, 8, true));
  return loadNamedScene(name).scene;
}

/// Returns the matrix that moves an object's middle to the origin and scales its largest side to 1 m.
glm::dmat4 toUnit(const CompiledScene& scene) {
  const glm::dvec3 lower = glm::dvec3(scene.boundsMin) + scene.origin,
                   upper = glm::dvec3(scene.boundsMax) + scene.origin;
  const glm::dvec3 size = upper - lower;
  return glm::translate(glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / std::max({size.x, size.y, size.z}))),
                        -0.5 * (lower + upper));
}

BenchmarkScene compiled(Scene scene, const std::string& name) {
  Warnings warnings;
  BenchmarkScene result{name, std::move(scene), {}};
  result.compiled = compileScene(result.scene, warnings);
  return result;
}

/// A scene without and with an object.
struct Put {
  BenchmarkScene without, alone, whole;
  VertexRange baked, object;

  Put(const Stage& stage, const std::string& model) : without(loadBuiltinScene(stage.scene)) {
    const BenchmarkScene shape = compiled(modelOf(model), model);
    const glm::dmat4 place = glm::rotate(glm::translate(glm::dmat4(1.0), stage.place), 0.5,
                                         glm::normalize(glm::dvec3(1.0, 0.3, 0.2))) *
                             toUnit(shape.compiled);
    Scene only, all = without.scene;
    appendObject(only, shape.scene, "Object", place);
    appendObject(all, shape.scene, "Object", place);
    alone = compiled(std::move(only), model);
    whole = compiled(std::move(all), without.name + ", " + sceneName(model));
    baked = {0, without.compiled.vertexCount(), 0, without.compiled.triangleCount()};
    object = {baked.vertexCount, whole.compiled.vertexCount() - baked.vertexCount, baked.triangleCount,
              whole.compiled.triangleCount() - baked.triangleCount};
  }
};

/// Times and error of one way to compute shadows.
struct Shown {
  double found = 0.0, move = 0.0;  ///< processor time, s
  MeasuredError error;
};

class ObjectTrial {
 public:
  ObjectTrial(const Stage& stage, const std::string& model, const PicturesOptions& options,
              const Device& device, const Progress& progress)
      : stage_(stage),
        put_(stage, model),
        options_(options),
        device_(device),
        progress_(progress),
        sky_(stage.hasSky ? makeLobedSky(objectSkyRows) : constantEnvironment(glm::vec3(0.0f))) {
    bake();
    mask();
    first_ = traced(firstTruthSeed);
    second_ = traced(secondTruthSeed);
    Picture black = first_;
    std::fill(black.pixels.begin(), black.pixels.end(), glm::vec3(0.0f));
    size_ = pictureRmse(first_, black);
  }

  const std::string& name() const { return put_.whole.name; }

  Shown show(Way way) {
    Bake bake = bake_;
    const GroupedLights* lamps = lamps_ ? &*lamps_ : nullptr;
    ObjectScene among(put_.whole.compiled, {put_.baked.triangleCount, put_.whole.compiled.triangleCount()},
                      lamps, device_);
    Shown shown;
    const double start = processorSeconds();
    if (way == Way::Occluders) among.shadeByOccluders(put_.whole.compiled, std::span(&put_.object, 1));
    if (way == Way::Neighbourhood)
      among.shadeByNeighbourhoods(put_.whole.compiled, std::span(&object_, 1), direct_);
    shown.found = processorSeconds() - start;
    ShadowedTransfer shadowed(put_.whole.compiled, put_.baked, bake_, among);
    if (way != Way::None) shown.move = timedMoves(among, shadowed, bake);
    const Picture picture = drawn(bake);
    const MeasuredError error = errorBetween(picture, first_, second_);
    shown.error = {error.rmse / size_, error.standardError / size_};
    return shown;
  }

 private:
  /// Bakes the scene without the object, with memory for the object's vertices.
  void bake() {
    BakeRequest request;
    request.sh.order = objectOrder;
    request.nearLamps.shells = 0;  // objects have none
    request.effort.rays = options_.objectRays;
    direct_ = timedBake(put_.without, request, device_, progress_).bake.sh->coefficients;
    request.bounces = objectOwnBounces;
    object_ = {put_.object, *timedBake(put_.alone, request, device_, progress_).bake.sh};
    request.bounces = stage_.bounces;
    request.lightGroups.wanted = !stage_.hasSky;
    bake_ = timedBake(put_.without, request, device_, progress_).bake;
    const std::size_t channels = std::size_t{3} * put_.whole.compiled.vertexCount();
    bake_.sh->coefficients.resize(channels * objectOrder * objectOrder, 0.0f);
    if (stage_.hasSky) return;
    lamps_ = groupLights(put_.whole.compiled, {});
    bake_.lightGroups->coefficients.resize(channels * bake_.lightGroups->groups.size(), 0.0f);
  }

  /// Finds the pixels that show the scene's surface around the object.
  void mask() {
    Tracer tracer(put_.whole.compiled, device_);
    const ObjectBall ball = ballAroundObject(put_.whole.compiled, put_.object);
    for (const SeenPlace& place :
         placesSeen(put_.whole.compiled, tracer,
                    {put_.whole.scene.cameras.at(0), options_.objectWidth, options_.objectHeight}))
      mask_.push_back(place.triangle < put_.baked.triangleCount &&
                      glm::distance(place.position, ball.centre) < seenRadii * ball.radius);
  }

  Picture masked(Picture picture) const {
    for (std::size_t i = 0; i < mask_.size(); ++i)
      if (!mask_[i]) picture.pixels[i] = glm::vec3(0.0f);
    return picture;
  }

  Picture traced(std::uint64_t seed) const {
    reference::ReferenceRequest request;
    request.samples = options_.objectSamples;
    request.seed = seed;
    request.depth = stage_.bounces + 2;
    request.width = options_.objectWidth;
    request.height = options_.objectHeight;
    return masked(tracedPicture(put_.whole, stage_.hasSky ? &sky_ : nullptr, request, device_, progress_));
  }

  Picture drawn(const Bake& bake) const {
    const viewer::RenderInputs inputs{put_.whole.scene, put_.whole.compiled, &bake, &sky_, &device_};
    viewer::RenderOptions options;
    options.shading = stage_.hasSky ? viewer::Shading::Sh : viewer::Shading::Lights;
    options.width = options_.objectWidth;
    options.height = options_.objectHeight;
    if (stage_.hasSky) options.lights.emplace();
    Warnings notes;
    return masked(renderPicture(inputs, options, notes));
  }

  /// Returns the seconds of moves of the object to and fro; it ends where it was.
  double timedMoves(ObjectScene& among, ShadowedTransfer& shadowed, Bake& bake) const {
    std::vector<double> seconds;
    for (int k = 0; k <= options_.objectMoves; ++k) {
      CompiledScene moved = put_.whole.compiled;
      for (std::uint32_t v = 0; v < put_.object.vertexCount && k < options_.objectMoves; ++v)
        moved.positions[put_.object.firstVertex + v].x += static_cast<float>(stepOfMove * (1 + k % 3));
      const double start = processorSeconds();
      among.follow(moved);
      shadowed.writeTo(moved, std::span(&put_.object, 1), bake);
      seconds.push_back(processorSeconds() - start);
    }
    return median(seconds);
  }

  const Stage& stage_;
  Put put_;
  const PicturesOptions& options_;
  const Device& device_;
  const Progress& progress_;
  Environment sky_;
  Bake bake_;
  std::vector<float> direct_;
  VolumeObject object_;
  std::optional<GroupedLights> lamps_;
  std::vector<bool> mask_;
  Picture first_, second_;
  double size_ = 0.0;
};

}  // namespace

void runObjects(const Device& device, const PicturesOptions& options, SuiteRun& run) {
  const viewer::gl::EglContext context;
  StepCounter steps(run, "bench objects", std::size(stages) * options.objectModels.size() * std::size(ways));
  for (const Stage& stage : stages)
    for (const std::string& model : options.objectModels) {
      ObjectTrial trial(stage, model, options, device, run);
      for (const NamedWay& way : ways) {
        const Shown shown = trial.show(way.way);
        const std::string name = fmt::format("{}/{}", trial.name(), way.name);
        const auto add = [&](const char* metric, double value, const char* unit) {
          run.results().push_back({name, metric, value, unit, {}, {}});
        };
        add("error", shown.error.rmse, "of rms");
        add("standard error", shown.error.standardError, "of rms");
        add("found once", shown.found, "s");
        add("move", shown.move, "s");
        steps.advance();
      }
    }
}

}  // namespace prelight::benchmarks
