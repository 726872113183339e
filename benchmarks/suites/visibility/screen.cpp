#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/suites/visibility/visibility_suite.h"
#include "benchmarks/truth/picture_error.h"
#include "benchmarks/truth/traced_accessibility.h"
#include "prelight/load.h"
#include "prelight/picture.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/techniques/screen/fields/field_occlusion.h"
#include "viewer/techniques/screen/occlusion_band.h"

namespace prelight::benchmarks {

namespace {

using viewer::OcclusionMethod;
using viewer::ScreenOcclusionOptions;

struct Variant {
  const char* name;
  ScreenOcclusionOptions options;
  bool moves = false;   ///< the scene moves before every frame
  bool reuses = false;  ///< a frame reuses results of earlier frames
};

void addDisks(const ScreenOcclusionOptions& disks, std::vector<Variant>& list) {
  list.push_back({"disks", disks});
  ScreenOcclusionOptions twice = disks, thrice = disks, coarse = disks, fine = disks, raw = disks;
  twice.passes = 2;
  thrice.passes = 3;
  coarse.opening = 0.8;
  fine.opening = 0.15;
  raw.filtered = false;
  list.push_back({"disks, 2 passes", twice});
  list.push_back({"disks, 3 passes", thrice});
  list.push_back({"disks, opening 0.8", coarse});
  list.push_back({"disks, opening 0.15", fine});
  list.push_back({"disks, not filtered", raw});
  list.push_back({"disks, scene moves", disks, true});
}

/// Adds cheaper variants of GTAO with fewer pixels, fewer slices or reuse of earlier pictures.
void addCheaper(const ScreenOcclusionOptions& gtao, std::vector<Variant>& list) {
  ScreenOcclusionOptions half = gtao, slice = gtao, both = gtao;
  half.stride = 2;
  slice.slices = 1;
  both.slices = 1;
  both.stride = 2;
  list.push_back({"gtao, every 2nd pixel", half});
  list.push_back({"gtao, 1 slice", slice});
  list.push_back({"gtao, 1 slice, every 2nd pixel", both});
  slice.frames = both.frames = 8;
  list.push_back({"gtao, 1 slice, 8 pictures", slice, false, true});
  list.push_back({"gtao, 1 slice, every 2nd pixel, 8 pictures", both, false, true});
}

void addFields(std::vector<Variant>& list) {
  ScreenOcclusionOptions fields;
  fields.method = OcclusionMethod::Fields;
  list.push_back({"fields", fields});
  ScreenOcclusionOptions coarse = fields, fine = fields;
  coarse.cells = 1 << 12;
  fine.cells = 1 << 17;
  list.push_back({"fields, 4096 cells", coarse});
  list.push_back({"fields, 131072 cells", fine});
  list.push_back({"fields, scene moves", fields, true});
}

std::vector<Variant> variants() {
  ScreenOcclusionOptions ssao, hbao, gtao, disks;
  ssao.method = OcclusionMethod::Ssao;
  hbao.method = OcclusionMethod::Hbao;
  std::vector<Variant> list = {{"ssao", ssao}, {"hbao", hbao}, {"gtao", gtao}};
  disks.method = OcclusionMethod::Disks;
  ScreenOcclusionOptions one = gtao, few = gtao, many = gtao, raw = gtao;
  one.layers = 1;
  few.slices = 2;
  few.steps = 4;
  many.slices = 16;
  many.steps = 16;
  raw.filtered = false;
  list.push_back({"gtao, 1 layer", one});
  list.push_back({"gtao, 2 slices of 4 steps", few});
  list.push_back({"gtao, 16 slices of 16 steps", many});
  list.push_back({"gtao, not filtered", raw});
  addCheaper(gtao, list);
  ScreenOcclusionOptions ssdo = gtao;
  ssdo.method = OcclusionMethod::Ssdo;
  ssdo.bounces = 0;  // without bounces it computes accessibility
  list.push_back({"ssdo", ssdo});
  addDisks(disks, list);
  addFields(list);
  return list;
}

/// Returns the radiance of a sky whose colour shows the direction of light: red from +X, green from -X, blue
/// from above.
glm::vec3 colouredSky(const glm::dvec3& w) {
  return glm::vec3(2.0 * std::max(w.x, 0.0), 2.0 * std::max(-w.x, 0.0), 2.0 * std::max(w.y, 0.0));
}

Environment environmentOf(const SkyFunction& sky) {
  Environment map{128, 64, {}};
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column)
      map.radiance.push_back(
          sky(Environment::direction((column + 0.5) / map.width, (row + 0.5) / map.height)));
  return map;
}

/// A white scene under a sky of radiance 1, or another sky.
struct WhiteScene {
  std::string name;
  Scene scene;
  CompiledScene compiled;
  Environment sky = constantEnvironment(glm::vec3(1.0f));

  explicit WhiteScene(const std::string& nameOrFile) : name(nameOrFile) {
    const bool isFile = nameOrFile.ends_with(".glb") || nameOrFile.ends_with(".gltf");
    if (isFile) name = std::filesystem::path(nameOrFile).stem().string();
    scene = whitened((isFile ? load(nameOrFile) : loadBuiltin(nameOrFile)).scene);
    Warnings warnings;
    compiled = compileScene(scene, warnings);
  }

  viewer::RenderInputs inputs(const Device& device) const {
    return {scene, compiled, nullptr, &sky, &device};
  }
};

std::vector<glm::vec3> displayed(const std::vector<float>& accessibility) {
  std::vector<glm::vec3> result;
  for (const float value : accessibility) result.push_back(toneMap(glm::vec3(value < 0.0f ? 1.0f : value)));
  return result;
}

std::vector<float> channelOf(const Picture& picture) {
  std::vector<float> result;
  for (const glm::vec3& pixel : picture.pixels) result.push_back(pixel.g);
  return result;
}

void writeGrey(const std::filesystem::path& folder, const std::string& name, const viewer::View& view,
               const std::vector<float>& values) {
  if (folder.empty()) return;
  Picture picture{view.width, view.height, {}};
  for (const float value : values) picture.pixels.emplace_back(value < 0.0f ? 1.0f : value);
  writePicture(folder / ("screen-" + name + ".png"), picture);
}

void writeColours(const std::filesystem::path& folder, const std::string& name, const viewer::View& view,
                  const std::vector<glm::vec3>& values) {
  if (folder.empty()) return;
  Picture picture{view.width, view.height, values};
  for (glm::vec3& value : picture.pixels) value = glm::max(value, glm::vec3(0.0f));
  writePicture(folder / ("screen-" + name + ".png"), picture);
}

/// Adds time and bytes of the fields of all objects, which are computed before the first frame.
void addCasting(const WhiteScene& scene, const Variant& variant, double radius, const Device& device,
                const Progress& progress, std::vector<BenchmarkResult>& results) {
  const auto cells = static_cast<std::size_t>(variant.options.cells);
  const auto rays = static_cast<std::uint32_t>(variant.options.fieldRays);
  std::size_t bytes = 0;
  std::vector<Contender> casting = {
      {variant.name, [&](std::size_t) {
         const viewer::FieldShapes shapes(scene.compiled, device, {radius, cells, rays});
         bytes = 0;
         for (const viewer::FieldShape& shape : shapes.shapes())
           bytes += viewer::FieldOcclusion::bytesOf(shape.field);
       }}};
  takeTurns(casting, 1, 1, progress);
  const double seconds = leastSeconds(casting.front().cpuSeconds, 1);
  const std::string name = scene.name + "/" + variant.name;
  results.push_back({name, "processor time of casting", seconds, "s", {}, {}});
  results.push_back({name, "fields", static_cast<double>(bytes), "bytes", {}, {}});
}

/// Adds FLIP of the drawn pictures, if it can be measured.
void addFlips(const std::string& scene, const std::vector<Variant>& list, const std::vector<glm::vec3>& truth,
              const std::vector<std::vector<glm::vec3>>& pictures, const viewer::View& view,
              std::vector<BenchmarkResult>& results) {
  std::vector<DisplayedPair> pairs;
  for (const std::vector<glm::vec3>& picture : pictures) pairs.push_back({truth, picture});
  const std::vector<double> flips = measureFlip(pairs, view.width, view.height);
  for (std::size_t i = 0; i < flips.size(); ++i)
    results.push_back({scene + "/" + list.at(i).name, "FLIP", flips[i], "1", {}, {}});
}

viewer::View screenView(const viewer::RenderInputs& inputs, const VisibilityOptions& options) {
  viewer::RenderOptions render;
  render.shading = viewer::Shading::Screen;
  render.width = options.screenWidth;
  render.height = options.screenHeight;
  return viewer::makeView(inputs, render);
}

void measure(const WhiteScene& scene, const Device& device, const VisibilityOptions& options,
             const Progress& progress, std::vector<BenchmarkResult>& results) {
  const viewer::RenderInputs inputs = scene.inputs(device);
  viewer::View view = screenView(inputs, options);
  Tracer tracer(scene.compiled, device);
  const double radius = viewer::occlusionRadius({}, scene.compiled);
  const std::vector<float> truth = tracedAccessibility(
      scene.compiled, tracer, {view.camera, view.width, view.height, radius, options.screenRays});
  writeGrey(options.folder, scene.name + "-traced", view, truth);
  const viewer::gl::Framebuffer target(view.width, view.height);
  const std::vector<Variant> list = variants();
  std::vector<std::vector<glm::vec3>> pictures;
  std::vector<Contender> contenders;
  const auto add = [&](const std::string& name, const char* metric, double value, const char* unit) {
    results.push_back({scene.name + "/" + name, metric, value, unit, {}, {}});
  };
  for (const Variant& variant : list) {
    view.screenOcclusion = variant.options;
    // Each variant has its own renderer, since renderers keep data of scenes that stand still.
    const auto renderer = std::make_shared<viewer::Renderer>(inputs);
    renderer->reuseOcclusion(variant.reuses);
    for (int i = 1; variant.reuses && i < variant.options.frames; ++i) viewer::renderView(*renderer, view, 1);
    const std::vector<float> drawn = channelOf(viewer::renderView(*renderer, view, 1));
    writeGrey(options.folder, scene.name + "-" + variant.name, view, drawn);
    add(variant.name, "rms error", accessibilityError(drawn, truth), "accessibility");
    pictures.push_back(displayed(drawn));
    if (variant.options.method == OcclusionMethod::Fields && !variant.moves)
      addCasting(scene, variant, radius, device, progress, results);
    contenders.push_back({variant.name, [&, renderer, view](std::size_t) {
                            if (variant.moves) renderer->sceneMoved();
                            renderer->draw(view, {0, 0, view.width, view.height}, target);
                            viewer::gl::Framebuffer::finish();
                          }});
  }
  addFlips(scene.name, list, displayed(truth), pictures, view, results);
  takeTurns(contenders, 1, options.screenFrames, progress);
  for (const Contender& contender : contenders) {
    add(contender.name, "frame", leastSeconds(contender.seconds, 1), "s");
    add(contender.name, "processor time of a frame", leastSeconds(contender.cpuSeconds, 1), "s");
  }
}

/// Compares light under a sky of several colours, with one bounce within the radius, with traced light.
void measureLight(WhiteScene& scene, const Device& device, const VisibilityOptions& options,
                  std::vector<BenchmarkResult>& results) {
  scene.sky = environmentOf(colouredSky);
  const viewer::RenderInputs inputs = scene.inputs(device);
  viewer::View view = screenView(inputs, options);
  Tracer tracer(scene.compiled, device);
  const AccessibilityRequest request{view.camera, view.width, view.height,
                                     viewer::occlusionRadius({}, scene.compiled), options.screenRays};
  AccessibilityRequest fewer = request;
  fewer.rays = std::max(options.screenRays / 8, 1);
  const std::vector<glm::vec3> direct = tracedSkyLight(scene.compiled, tracer, request, colouredSky);
  const std::vector<glm::vec3> bounce = tracedBounce(scene.compiled, tracer, fewer, colouredSky, 16);
  std::vector<glm::vec3> all = direct;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (direct[i].r >= 0.0f) all[i] += bounce[i];
  writeColours(options.folder, scene.name + "-light-traced", view, direct);
  writeColours(options.folder, scene.name + "-bounce-traced", view, bounce);
  viewer::Renderer renderer(inputs);
  const auto add = [&](const std::string& name, const char* metric, double value) {
    results.push_back({scene.name + "/" + name, metric, value, "irradiance over pi", {}, {}});
  };
  std::vector<glm::vec3> drawn;
  const auto draw = [&](const std::string& name, OcclusionMethod method, int bounces) {
    view.screenOcclusion.method = method;
    view.screenOcclusion.bounces = bounces;
    drawn = viewer::renderView(renderer, view, 1).pixels;
    writeColours(options.folder, scene.name + "-light-" + name, view, drawn);
    add(name, "rms error of the sky's light", lightError(drawn, direct));
    add(name, "rms error of the sky's light and one bounce", lightError(drawn, all));
  };
  draw("gtao", OcclusionMethod::Gtao, 0);
  draw("ssdo", OcclusionMethod::Ssdo, 0);
  const std::vector<glm::vec3> without = drawn;
  draw("ssdo, bounce", OcclusionMethod::Ssdo, 1);
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i] -= without[i];
  writeColours(options.folder, scene.name + "-bounce-ssdo", view, drawn);
  add("ssdo, bounce", "rms error of the bounce", lightError(drawn, bounce));
  add("no bounce", "rms error of the bounce",
      lightError(std::vector<glm::vec3>(bounce.size(), glm::vec3(0.0f)), bounce));
}

}  // namespace

void runScreen(const Device& device, const VisibilityOptions& options, SuiteRun& run) {
  const viewer::gl::EglContext context;
  StepCounter steps(run, "bench screen", options.screenScenes.size());
  std::vector<BenchmarkResult>& results = run.results();
  for (const std::string& name : options.screenScenes) {
    WhiteScene scene(name);
    measure(scene, device, options, run, results);
    measureLight(scene, device, options, results);
    steps.advance();
  }
}

}  // namespace prelight::benchmarks
