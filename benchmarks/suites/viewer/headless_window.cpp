#include "benchmarks/suites/viewer/headless_window.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <thread>

#include "bake/animated_bake.h"
#include "benchmarks/run/timing.h"
#include "scene/light_sources.h"
#include "viewer/follow/live_follower.h"
#include "viewer/follow/radiosity_follower.h"
#include "viewer/follow/virtual_light_follower.h"
#include "viewer/frame/view.h"

namespace prelight::benchmarks {
namespace {

using viewer::FramePass;
using viewer::Shading;

constexpr int samplesPerAxis = 2;                            // samples per axis of still pictures
constexpr auto waitForLight = std::chrono::milliseconds(1);  // pause while another thread computes light

const char* nameOf(FramePass pass) {
  switch (pass) {
    case FramePass::Transfer:
      return "transfer";
    case FramePass::ShadowMaps:
      return "shadow maps";
    case FramePass::VirtualLights:
      return "virtual lights";
    case FramePass::EnvironmentMaps:
      return "environment maps";
    case FramePass::Caustics:
      return "caustics";
    case FramePass::ScreenOcclusion:
      return "screen occlusion";
    case FramePass::Opaque:
      return "opaque";
    case FramePass::Blended:
      return "blended";
  }
  return "";  // no other pass
}

/// Returns the options that `prelight view` uses (pictures/followed_light.cpp).
LiveLightOptions followingOptions(int pixels) {
  LiveLightOptions options = optionsOfWindows();
  options.photons = 50000;
  options.texels = static_cast<std::uint32_t>(std::clamp(pixels / 32, 4096, 65536));
  options.gather.rays = 128;
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

}  // namespace

WindowStage::WindowStage(const BenchmarkScene& shown, const Environment* shownSky, Shading shading,
                         const WindowSettings& settings, const Device& device, const Progress& progress)
    : scene(shown),
      sky(shownSky),
      inputs{.scene = scene.scene, .compiled = scene.compiled, .environment = sky, .device = &device} {
  if (shading != Shading::GlobalIllumination && shading != Shading::Instant) {
    bakeFor(shading, settings, device, progress);
    return;
  }
  StopOnly quiet(progress);
  if (shading == Shading::Instant) {
    virtualLights.emplace(scene.scene, scene.compiled, sky, 0.0, InstantOptions{}, device, quiet);
    inputs.virtualLights = &virtualLights->lights();
    return;
  }
  live.emplace(scene.scene, scene.compiled, sky, 0.0, followingOptions(settings.width * settings.height),
               std::span<const int>(), device, quiet);
  globalIllumination = illuminationOf(*live);
  inputs.globalIllumination = &globalIllumination;
}

void WindowStage::bakeFor(Shading shading, const WindowSettings& settings, const Device& device,
                          const Progress& progress) {
  BakeRequest asked, request;
  asked.sh.order = asked.ch.order = settings.order;
  viewer::infoOf(shading).addTo(request, asked);
  if (!request.anything()) return;
  if (sky != nullptr) request.radiosity.environment = std::make_shared<Environment>(*sky);
  request.effort.rays = settings.rays;
  bake = timedBake(scene, request, device, progress).bake;
  if (request.sh.order > 0 && !scene.scene.animations.empty()) {
    StopOnly quiet(progress);
    AnimationReport report;
    bake.animation = bakeAnimation(scene.scene, scene.compiled, 0, request, {}, bake, device, quiet, report);
  }
  inputs.bake = &bake;
  if (shading == Shading::Radiosity)
    radiosity.emplace(scene.compiled, request,
                      DeviceOptions{.selector = std::to_string(device.info().index)});
}

std::unique_ptr<viewer::LightFollower> WindowStage::makeFollower() {
  if (live) return std::make_unique<viewer::LiveFollower>(*live, globalIllumination);
  if (virtualLights) return std::make_unique<viewer::VirtualLightFollower>(*virtualLights);
  if (!radiosity) return nullptr;
  return std::make_unique<viewer::RadiosityFollower>(
      *radiosity, RadiosityLights{scene.scene.lights, shiningSky(sky), 0.0});
}

/// A framebuffer of eight bits per channel, like that of a window.
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
      light_(stage.makeFollower()),
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
  if (settled)
    picture_.finish(controls_.view(), controls_.changes());
  else
    picture_.update(controls_.view(), controls_.changes(), false);
  presenter_.present(picture_.shown(), 1, screen_->name());
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
  renderer_.observePasses([&](const viewer::DrawnPass& drawn) { passed(nameOf(drawn.pass)); });
  if (follower_.update(controls_) || renderer_.isBehind()) picture_.invalidate();
  passed("light that follows");
  if (settled)
    picture_.finish(controls_.view(), controls_.changes());
  else
    picture_.update(controls_.view(), controls_.changes(), false);
  presenter_.present(picture_.shown(), 1, screen_->name());
  passed("presentation");
  renderer_.observePasses({});
  return times;
}

/// No pictures are drawn before light has settled.
bool HeadlessWindow::settle(double mostSeconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(mostSeconds);
  follower_.update(controls_);
  while (follower_.isBusy(controls_.view()) && std::chrono::steady_clock::now() < end) {
    if (controls_.view().shading == Shading::Radiosity) std::this_thread::sleep_for(waitForLight);
    follower_.update(controls_);
  }
  do frame(true);
  while (renderer_.isBehind());
  return !follower_.isBusy(controls_.view());
}

void HeadlessWindow::still() {
  picture_.invalidate();
  frame(true);
}

}  // namespace prelight::benchmarks
