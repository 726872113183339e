#include "viewer/frame/render.h"

#include <algorithm>
#include <string>

#include "prelight/error.h"
#include "scene/dropped_features.h"
#include "viewer/frame/renderer.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/options/group_option.h"

namespace prelight::viewer {
namespace {

constexpr int maxSize = 32768;        ///< pixels a side
constexpr int maxTileSamples = 2048;  ///< samples a side of what is drawn at once

void checkOptions(const RenderOptions& options) {
  if (options.width < 0 || options.width > maxSize || options.height < 1 || options.height > maxSize) {
    throw UsageError("--size " + std::to_string(options.width) + "x" + std::to_string(options.height),
                     "a picture is 1 to " + std::to_string(maxSize) + " pixels wide and high");
  }
  if (options.samplesPerAxis < 1 || options.samplesPerAxis > 8) {
    throw UsageError("samples per axis", "1 to 8, got " + std::to_string(options.samplesPerAxis));
  }
}

}  // namespace

void resolve(const gl::Framebuffer& samples, int samplesPerAxis, const Tile& tile, Picture& picture) {
  const std::vector<glm::vec4> values = samples.read();
  const float weight = 1.0f / static_cast<float>(samplesPerAxis * samplesPerAxis);
  for (int y = 0; y < tile.height; ++y) {
    const int firstRow = (tile.height - 1 - y) * samplesPerAxis;  // OpenGL's rows go upwards
    for (int x = 0; x < tile.width; ++x) {
      glm::vec3 sum(0.0f);
      for (int j = 0; j < samplesPerAxis; ++j) {
        const std::size_t row = static_cast<std::size_t>(firstRow + j) * samples.width();
        for (int i = 0; i < samplesPerAxis; ++i) sum += glm::vec3(values[row + x * samplesPerAxis + i]);
      }
      picture.pixels[static_cast<std::size_t>(tile.y + y) * picture.width + tile.x + x] = sum * weight;
    }
  }
}

View makeView(const RenderInputs& inputs, const RenderOptions& options) {
  checkOptions(options);
  View view;
  static_cast<ShadingOptions&>(view) = options;
  const double aspect =
      options.width > 0 ? static_cast<double>(options.width) / options.height : defaultAspect;
  view.camera = chooseCamera(inputs.scene, inputs.compiled, options.camera, aspect);
  view.height = options.height;
  view.width =
      options.width > 0 ? options.width : std::min(pictureWidth(view.camera, options.height), maxSize);
  view.shading = options.shading;
  view.skyRotation = options.skyRotation;
  view.lights = options.lights.value_or(inputs.scene.lights);
  view.emitters = options.emitters;
  view.layers = options.layers;
  view.debug = options.debug;
  if (inputs.bake != nullptr && inputs.bake->lightGroups)
    view.groupFactors = groupFactors(namesOf(*inputs.bake->lightGroups), options.groups);
  return view;
}

Picture renderView(Renderer& renderer, const View& view, int samplesPerAxis,
                   std::vector<PictureChannel>* layers) {
  const Picture black{view.width, view.height,
                      std::vector<glm::vec3>(static_cast<std::size_t>(view.width) * view.height)};
  Picture picture = black;
  const std::vector<DrawnLayer> wanted =
      layers != nullptr ? renderer.layersOf(view) : std::vector<DrawnLayer>();
  std::vector<Picture> drawn(wanted.size(), black);
  const int step = maxTileSamples / samplesPerAxis;
  for (int y = 0; y < view.height; y += step) {
    for (int x = 0; x < view.width; x += step) {
      const Tile tile{x, y, std::min(step, view.width - x), std::min(step, view.height - y)};
      const gl::Framebuffer target(tile.width * samplesPerAxis, tile.height * samplesPerAxis);
      const LayerRequest request{wanted, [&](const DrawnLayer* layer) {
                                   resolve(target, samplesPerAxis, tile,
                                           layer == nullptr ? picture : drawn[layer - wanted.data()]);
                                 }};
      renderer.draw(view, tile, target, request);
    }
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) addLayer(wanted[i], std::move(drawn[i].pixels), *layers);
  return picture;
}

Picture renderPicture(const RenderInputs& inputs, const RenderOptions& options, Warnings& notes,
                      std::vector<PlannedPass>* plan, std::vector<PictureChannel>* layers) {
  const View view = makeView(inputs, options);
  const gl::EglContext context;
  Renderer renderer(inputs, options.lobe);
  renderer.describe(view, notes);
  if (showsAllLight(view.shading))
    noteDroppedFeatures(inputs.scene, inputs.compiled, MaterialPath::DrawnFull,
                        std::string(shadingName(view.shading)) + " shading", notes);
  if (plan != nullptr) *plan = renderer.plan(view);
  return renderView(renderer, view, options.samplesPerAxis, layers);
}

}  // namespace prelight::viewer
