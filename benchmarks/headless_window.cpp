#include "benchmarks/headless_window.h"

#include <algorithm>
#include <array>
#include <functional>

#include "bake/animated_bake.h"
#include "benchmarks/processor_time.h"
#include "viewer/view.h"
#include "viewer/virtual_light_follower.h"

namespace prelight::benchmarks {
namespace {

using viewer::FramePass;
using viewer::Shading;

constexpr int samplesPerAxis = 2;        // of pictures that stand still
constexpr int mostSettlingFrames = 400;  // until light that follows has settled

constexpr const char* nameOf(FramePass pass) {
  constexpr std::array<const char*, 6> names = {"transfer", "shadow maps", "environment maps",
                                                "caustics", "opaque",      "blended"};
  return names[static_cast<std::size_t>(pass)];
}

/// As `prelight view` sets it up (cli/drawn_global_illumination.cpp).
LiveLightOptions followingOptions(int pixels) {
  LiveLightOptions options;
  options.photons = 50000;
  options.texels = static_cast<std::uint32_t>(std::clamp(pixels / 32, 4096, 65536));
  options.gather.rays = 128;
  options.gather.texelsPerFrame = 100;
  options.photonsPerFrame = 4000;
  options.causticPhotons = 20000;
  return options;
}

viewer::View viewOf(const viewer::RenderInputs& inputs, Shading shading, const WindowSettings& settings) {
  viewer::RenderOptions render;
  render.shading = shading;
  render.width = settings.width;
  render.height = settings.height;
  return viewer::makeView(inputs, render);
}

std::unique_ptr<viewer::LightFollower> followerOf(WindowStage& stage) {
  if (stage.live) return std::make_unique<viewer::LiveFollower>(*stage.live, stage.globalIllumination);
  if (stage.virtualLights) return std::make_unique<viewer::VirtualLightFollower>(*stage.virtualLights);
  return nullptr;
}

}  // namespace

WindowStage::WindowStage(const StageLook& look, Shading shading, const WindowSettings& settings,
                         const Device& device, const Progress& progress)
    : scene(loadBuiltinScene(look.scene)),
      inputs{.scene = scene.scene, .compiled = scene.compiled, .environment = look.sky, .device = &device} {
  if (shading == Shading::GlobalIllumination) {
    StopOnly quiet(progress);
    live.emplace(scene.scene, scene.compiled, look.sky, 0.0,
                 followingOptions(settings.width * settings.height), std::span<const int>(), device, quiet);
    globalIllumination = illuminationOf(*live);
    inputs.globalIllumination = &globalIllumination;
    return;
  }
  if (shading == Shading::Instant) {
    StopOnly quiet(progress);
    virtualLights.emplace(scene.scene, scene.compiled, look.sky, 0.0, VirtualLightOptions{}, device, quiet);
    inputs.virtualLights = &virtualLights->lights();
    return;
  }
  BakeRequest asked, request;
  asked.sh.order = asked.ch.order = settings.order;
  viewer::infoOf(shading).addTo(request, asked);
  if (request.anything()) {
    if (look.sky != nullptr) request.radiosity.environment = std::make_shared<Environment>(*look.sky);
    request.effort.rays = settings.rays;
    bake = timedBake(scene, request, device, progress).bake;
    if (request.sh.order > 0 && !scene.scene.animations.empty()) {
      StopOnly quiet(progress);
      AnimationReport report;
      bake.animation =
          bakeAnimation(scene.scene, scene.compiled, 0, request, {}, *bake.sh, device, quiet, report);
    }
    inputs.bake = &bake;
  }
}

/// What is drawn into: eight bits a channel, as windows have.
class HeadlessWindow::Screen {
 public:
  Screen(int width, int height) {
    glBindRenderbuffer(GL_RENDERBUFFER, color_.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.name());
  }
  GLuint name() const { return framebuffer_.name(); }

 private:
  viewer::gl::Renderbuffer color_;
  viewer::gl::Object<viewer::gl::FramebufferTraits> framebuffer_;
};

HeadlessWindow::HeadlessWindow(WindowStage& stage, Shading shading, const WindowSettings& settings)
    : played_(stage.scene.scene),
      scene_(stage.inputs),
      renderer_(scene_.shown()),
      light_(followerOf(stage)),
      follower_(
          renderer_, scene_,
          light_ ? std::vector<viewer::LightFollower*>{light_.get()} : std::vector<viewer::LightFollower*>{}),
      picture_(renderer_, samplesPerAxis),
      screen_(std::make_unique<Screen>(settings.width, settings.height)),
      controls_(
          viewOf(stage.inputs, shading, settings), stage.scene.compiled, [](Shading) { return true; }, {},
          dragNodes(scene_)) {
  controls_.startFollowing({scene_.lights(), scene_.cameras()}, {true, std::nullopt});
  renderer_.paceUpdates(true);
}

HeadlessWindow::~HeadlessWindow() = default;

bool HeadlessWindow::play() {
  viewer::Playback playback(played_);
  playback.toggle();
  if (playback.exists() && scene_.showsMoments()) controls_.setPlayback(playback);
  return controls_.playback().plays();
}

void HeadlessWindow::frame(bool settled) {
  if (follower_.update(controls_) || renderer_.isBehind()) picture_.invalidate();
  picture_.update(controls_.view(), controls_.changes(), settled);
  presenter_.present(picture_.target(), picture_.samples(), screen_->name());
  viewer::gl::Framebuffer::finish();
}

PartTimes HeadlessWindow::timedFrame(bool settled) {
  PartTimes times;
  double before = processorSeconds();
  const auto passed = [&](const std::string& part) {
    viewer::gl::Framebuffer::finish();
    const double now = processorSeconds();
    times[part] += 1e3 * (now - before);
    before = now;
  };
  renderer_.observePasses([&](FramePass pass) { passed(nameOf(pass)); });
  if (follower_.update(controls_) || renderer_.isBehind()) picture_.invalidate();
  passed("light that follows");
  picture_.update(controls_.view(), controls_.changes(), settled);
  presenter_.present(picture_.target(), picture_.samples(), screen_->name());
  passed("presentation");
  renderer_.observePasses({});
  return times;
}

/// Pictures are not drawn before light has settled: they would be drawn in vain.
bool HeadlessWindow::settle() {
  follower_.update(controls_);
  for (int i = 0; i < mostSettlingFrames && follower_.isBusy(controls_.view()); ++i)
    follower_.update(controls_);
  do frame(true);
  while (renderer_.isBehind());
  return !follower_.isBusy(controls_.view());
}

void HeadlessWindow::still() {
  picture_.invalidate();
  frame(true);
}

}  // namespace prelight::benchmarks
