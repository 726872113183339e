#include "viewer/follow/frames.h"

#include "prelight/error.h"
#include "viewer/frame/renderer.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"

namespace prelight::viewer {
namespace {

/// The lights and the camera of a picture where its scene stands now.
void follow(const PosedScene& scene, const RenderOptions& options, View& view) {
  if (!options.lights) view.lights = scene.lights();
  const auto camera = static_cast<std::size_t>(options.camera.value_or(0));
  if (camera < scene.cameras().size()) view.camera = scene.cameras()[camera];
}

}  // namespace

void renderFrames(const RenderInputs& inputs, const RenderOptions& options, const PoseSources& sources,
                  std::span<const SceneMoment> moments, const FrameSink& take, Warnings& notes) {
  View view = makeView(inputs, options);
  const gl::EglContext context;
  PosedScene scene(inputs, sources);
  if (!scene.showsMoments())
    throw UsageError("a sequence of pictures", "global illumination and caustics belong to one moment");
  Renderer renderer(scene.shown(), options.lobe);
  renderer.reuseOcclusion(true);
  renderer.describe(view, notes);
  for (std::size_t frame = 0; frame < moments.size(); ++frame) {
    showPose(scene, renderer, {moments[frame], {}}, view.shading);
    follow(scene, options, view);
    const Warnings stayed = scene.takeNotes();
    notes.insert(notes.end(), stayed.begin(), stayed.end());
    std::vector<PictureChannel> layers;
    const Picture picture =
        renderView(renderer, view, options.samplesPerAxis, options.layersOfFrames ? &layers : nullptr);
    take(frame, picture, layers);
  }
}

}  // namespace prelight::viewer
