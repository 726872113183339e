#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "benchmarks/lab/made_materials.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/suites/pictures/pictures_suite.h"
#include "benchmarks/suites/pictures/sky_pictures.h"
#include "scene/builtin/mesh_shapes.h"
#include "scene/gltf/charts.h"
#include "scene/measured_brdf.h"
#include "viewer/gl/egl_context.h"

namespace prelight::benchmarks {

namespace {

constexpr int materialSkyRows = 64;
constexpr int throughOrder = 5, throughBounces = 6;
constexpr int reliefOrder = 4;

Material& materialNamed(Scene& scene, const std::string& name) {
  return *std::find_if(scene.materials.begin(), scene.materials.end(),
                       [&](const Material& material) { return material.name == name; });
}

/// Returns `shapes` with other materials for its ball and ring.
BenchmarkScene shapesWith(const std::string& name, const Material& ball, const Material& ring) {
  BenchmarkScene scene = loadBuiltinScene("shapes");
  scene.name = name;
  materialNamed(scene.scene, "Red") = ball;
  materialNamed(scene.scene, "Yellow") = ring;
  Warnings warnings;
  scene.compiled = compileScene(scene.scene, warnings);
  return scene;
}

/// Returns a body without a reflecting layer, which light enters and leaves everywhere alike.
Material scatteringBody(const glm::vec3& color, float distance, float anisotropy) {
  Material body;
  body.baseColor = glm::vec4(1.0f);
  body.metallic = 0.0f;
  body.specular = 0.0f;
  body.diffuseTransmission = 1.0f;
  body.thickness = 1.0f;
  body.attenuationColor = glm::vec3(std::exp(-1.0f));
  body.attenuationDistance = distance;
  body.multiscatterColor = color;
  body.scatterAnisotropy = anisotropy;
  return body;
}

Material measuredMetal(const glm::dvec3& color, double roughness, const glm::dvec3& body) {
  const BrdfModel lobe = ggxModel(color, roughness);
  const auto model = [&](const glm::dvec3& wo, const glm::dvec3& wi) {
    return lobe(wo, wi) + body / std::numbers::pi;
  };
  Material material;
  setMeasured(std::make_shared<const MeasuredBrdf>(tabulatedBrdf(model, "table")), material);
  return material;
}

/// Returns a square of 2 m whose normal texture has grooves.
BenchmarkScene groovedGround() {
  const MeshShape grid = makeGrid({-1.0, 0.0, 1.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, -2.0}, 4, 4);
  BenchmarkScene scene;
  scene.name = "grooves";
  Primitive primitive;
  primitive.positions = grid.positions;
  primitive.normals = grid.normals;
  primitive.texCoords0 = grid.texCoords;
  primitive.triangles = grid.triangles;
  primitive.material = 0;
  scene.scene.meshes.push_back({"Ground", {primitive}});
  Material& material = scene.scene.materials.emplace_back();
  material.metallic = 0.0f;
  material.normalTexture.image = 0;
  scene.scene.images.push_back(grooves::normals());
  scene.scene.nodes.emplace_back();
  MeshNode& node = scene.scene.meshNodes.emplace_back();
  node.transforms.emplace_back(1.0);
  Warnings warnings;
  scene.compiled = compileScene(scene.scene, warnings);
  return scene;
}

/// Returns the RMS error, over the columns of the middle groove, of the light of an even sky, compared with
/// marching.
double errorOfGrooves(const ChartTransfer::Map& map, std::size_t columns) {
  const double evenSky = std::sqrt(4.0 * std::numbers::pi);
  const auto width = static_cast<std::size_t>(map.width), height = static_cast<std::size_t>(map.height);
  const int first = static_cast<int>(grooves::period), count = first;
  double squares = 0.0;
  for (int x = first; x < first + count; ++x) {
    double open = 0.0;
    for (std::size_t row = 0; row < height; ++row)
      open += evenSky * double(map.coefficients[(row * width + static_cast<std::size_t>(x)) * columns]) /
              static_cast<double>(height);
    squares += std::pow(open - grooves::openAt(x), 2.0);
  }
  return std::sqrt(squares / count);
}

class MaterialMeter {
 public:
  MaterialMeter(const Device& device, const PicturesOptions& options, SuiteRun& run)
      : device_(device), options_(options), run_(run), steps_(run, "bench materials", stepCount(options)) {}

  void measureBodies() {
    const BenchmarkScene scene = shapesWith("bodies", scatteringBody({0.9f, 0.7f, 0.5f}, 0.15f, 0.0f),
                                            scatteringBody({0.5f, 0.8f, 0.6f}, 0.1f, 0.3f));
    const SkyTrial trial(scene, sky_, options_, device_, run_);
    BakeRequest request;
    request.sh.order = throughOrder;
    request.bounces = throughBounces;
    for (const bool with : {false, true})
      for (const std::uint64_t rays : options_.materialRays) {
        request.subsurface = with;
        request.effort.rays = rays;
        add(fmt::format("bodies/{}/{}", with ? "subsurface transport" : "surfaces alone", rays),
            trial.draw(request, viewer::Shading::Sh));
      }
    tracePaths(trial, scene.name);
  }

  void measureTables() {
    const BenchmarkScene scene = shapesWith("tables", measuredMetal({1.0, 0.76, 0.33}, 0.5, glm::dvec3(0.0)),
                                            measuredMetal(glm::dvec3(0.05), 0.4, {0.5, 0.1, 0.1}));
    const SkyTrial trial(scene, sky_, options_, device_, run_);
    for (const bool table : {false, true})
      for (const int order : options_.materialOrders) {
        BakeRequest request;
        (table ? request.glossy.order : request.sh.order) = order;
        request.bounces = 2;
        request.effort.rays = options_.materialRays.back();
        add(fmt::format("tables/{}/{}", table ? "table in SH" : "fitted lobe", order),
            trial.draw(request, table ? viewer::Shading::Glossy : viewer::Shading::Sh));
      }
    tracePaths(trial, scene.name);
  }

  void measureRelief() {
    const BenchmarkScene scene = groovedGround();
    const Charts charts = makeCharts(scene.scene, scene.compiled, grooves::texels);
    for (const bool relief : {false, true})
      for (const std::uint64_t rays : options_.materialRays) {
        BakeRequest request;
        request.sh.order = reliefOrder;
        request.chartTransfer = {grooves::texels, relief};
        request.effort.rays = rays;
        const double start = processorSeconds();
        const TimedBake baked = timedBake(scene, request, device_, run_, &charts);
        const double seconds = processorSeconds() - start;
        const std::size_t columns = std::size_t{reliefOrder} * reliefOrder;
        add(fmt::format("grooves/{}/{}", relief ? "relief" : "normals alone", rays),
            {{errorOfGrooves(baked.bake.chartTransfer.value().maps.at(0), columns), 0.0},
             seconds,
             baked.report.rays});
      }
  }

 private:
  static std::size_t stepCount(const PicturesOptions& options) {
    return 4 * options.materialRays.size() + 2 * options.materialOrders.size() +
           2 * options.materialSamples.size();
  }

  void tracePaths(const SkyTrial& trial, const std::string& scene) {
    for (const std::uint64_t samples : options_.materialSamples)
      add(fmt::format("{}/path tracing/{}", scene, samples), trial.trace(samples));
  }

  void add(const std::string& name, const SkyPicture& result) {
    const char* unit = name.starts_with("grooves") ? "accessibility" : "of rms";
    run_.results().push_back({name, "time", result.seconds, "s", {}, {}});
    run_.results().push_back({name, "error", result.error.rmse, unit, {}, {}});
    if (result.rays > 0)
      run_.results().push_back({name, "rays", static_cast<double>(result.rays), "rays", {}, {}});
    steps_.advance();
  }

  const Device& device_;
  const PicturesOptions& options_;
  SuiteRun& run_;
  StepCounter steps_;
  Environment sky_ = makeLobedSky(materialSkyRows);
};

}  // namespace

void runMaterials(const Device& device, const PicturesOptions& options, SuiteRun& run) {
  const viewer::gl::EglContext context;
  MaterialMeter meter(device, options, run);
  meter.measureBodies();
  meter.measureTables();
  meter.measureRelief();
}

}  // namespace prelight::benchmarks
