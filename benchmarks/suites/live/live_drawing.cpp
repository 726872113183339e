#include "benchmarks/suites/live/live_drawing.h"

#include <algorithm>

#include "gi/update/live_light.h"
#include "viewer/frame/renderer.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"

namespace prelight::benchmarks {

struct LiveDrawing::Parts {
  Parts(const BenchmarkScene& scene, const LiveLight& followed, int side)
      : live(followed),
        globalIllumination(illuminationOf(followed)),
        inputs{.scene = scene.scene,
               .compiled = followed.scene().compiled(),
               .globalIllumination = &globalIllumination},
        renderer(inputs),
        target(side, side),
        photons(globalIllumination.photons) {
    viewer::RenderOptions options;
    options.shading = viewer::Shading::GlobalIllumination;
    options.width = options.height = side;
    view = viewer::makeView(inputs, options);
    renderer.paceUpdates(true);
  }

  const LiveLight& live;
  viewer::gl::EglContext context;
  GlobalIllumination globalIllumination;
  viewer::RenderInputs inputs;
  viewer::Renderer renderer;
  viewer::gl::Framebuffer target;
  viewer::View view;
  std::vector<device::Photon> photons;
};

LiveDrawing::LiveDrawing(const BenchmarkScene& scene, const LiveLight& live, int side)
    : parts_(std::make_unique<Parts>(scene, live, side)) {}

LiveDrawing::~LiveDrawing() = default;

void LiveDrawing::draw(const LiveFrame& frame, bool moved) {
  Parts& p = *parts_;
  if (moved) p.renderer.sceneMoved();
  if (frame.shownChanged) {
    LightMap& map = p.globalIllumination.indirect;
    std::fill(map.values.begin(), map.values.end(), 0.0f);
    if (!p.live.indirect().empty()) setIrradiance(p.live, map);
    p.renderer.update(viewer::Shading::GlobalIllumination, {.indirect = map.values});
  }
  if (frame.causticsChanged) {
    p.photons = p.live.caustics();
    const viewer::Caustics caustics{p.photons, p.globalIllumination.caustics.filter};
    p.renderer.update(viewer::Shading::GlobalIllumination, {.caustics = &caustics});
  }
  p.renderer.draw(p.view, {0, 0, p.view.width, p.view.height}, p.target);
  viewer::gl::Framebuffer::finish();
}

}  // namespace prelight::benchmarks
