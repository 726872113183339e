#include "viewer/window/window.h"

#include <epoxy/gl.h>
// After epoxy, whose declarations it takes.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "prelight/error.h"
#include "prelight/picture.h"
#include "viewer/follow/posed_scene.h"
#include "viewer/frame/view.h"
#include "viewer/gl/libraries.h"
#include "viewer/options/group_option.h"
#include "viewer/window/controls.h"
#include "viewer/window/key_help.h"
#include "viewer/window/live_picture.h"
#include "viewer/window/overlay.h"
#include "viewer/window/presenter.h"
#include "viewer/window/scene_follower.h"

namespace prelight::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double settleTime = 0.2;  ///< s without a change until a picture gets all its samples
constexpr double shownEvery =
    0.1;  ///< s until further slices of a picture that nothing else changes are shown
constexpr double countedFrame = 1.0 / 60.0;  ///< s that pass in a frame of a window that counts them

std::string glfwReason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown reason";
}

/// GLFW from init to terminate.
struct GlfwSession {
  GlfwSession() {
    if (glfwInit() == GLFW_TRUE) return;
    throw Error(ExitCode::RuntimeFailure, "window", "no display: " + glfwReason(),
                "use `prelight render`, which needs none, or run under xvfb-run");
  }
  ~GlfwSession() { glfwTerminate(); }
  GlfwSession(const GlfwSession&) = delete;
  GlfwSession& operator=(const GlfwSession&) = delete;
};

struct DestroyWindow {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowHandle = std::unique_ptr<GLFWwindow, DestroyWindow>;

WindowHandle openWindow(const ViewerOptions& options, int width, int height) {
  gl::requireOpenGl();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  WindowHandle window(glfwCreateWindow(width, height, options.title.c_str(), nullptr, nullptr));
  if (!window) {
    const std::string reason = glfwReason();
    gl::requireGlx();
    throw Error(ExitCode::RuntimeFailure, "window", "no window with OpenGL 4.1: " + reason,
                "use `prelight render`, which needs no display");
  }
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(options.frames > 0 ? 0 : 1);
  return window;
}

std::optional<Command> commandOf(int key) {
  switch (key) {
    case GLFW_KEY_Q:
      return Command::SkyLeft;
    case GLFW_KEY_E:
      return Command::SkyRight;
    case GLFW_KEY_TAB:
      return Command::NextLight;
    case GLFW_KEY_L:
      return Command::AddLight;
    case GLFW_KEY_N:
      return Command::NextNode;
    case GLFW_KEY_SPACE:
      return Command::PlayOrPause;
    case GLFW_KEY_LEFT:
      return Command::FrameBack;
    case GLFW_KEY_RIGHT:
      return Command::FrameOn;
    case GLFW_KEY_HOME:
      return Command::ToStart;
    case GLFW_KEY_LEFT_BRACKET:
      return Command::Slower;
    case GLFW_KEY_RIGHT_BRACKET:
      return Command::Faster;
    case GLFW_KEY_G:
      return Command::NextGroup;
    case GLFW_KEY_PAGE_UP:
      return Command::BrightenGroup;
    case GLFW_KEY_PAGE_DOWN:
      return Command::DimGroup;
    case GLFW_KEY_P:
      return Command::ToggleProbes;
    case GLFW_KEY_R:
      return Command::ResetView;
    default:
      return std::nullopt;
  }
}

Drag dragOf(int button, int modifiers) {
  if (button == GLFW_MOUSE_BUTTON_RIGHT)
    return (modifiers & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL)) != 0 ? Drag::Node : Drag::Light;
  if (button == GLFW_MOUSE_BUTTON_MIDDLE) return Drag::Pan;
  if (button != GLFW_MOUSE_BUTTON_LEFT) return Drag::None;
  if ((modifiers & GLFW_MOD_SHIFT) != 0) return Drag::Sky;
  return (modifiers & GLFW_MOD_CONTROL) != 0 ? Drag::Pan : Drag::Orbit;
}

/// Hands GLFW's events to the controls, unless the overlay takes them.
class EventRouter {
 public:
  /// Installs the callbacks; the overlay is attached afterwards, since it chains to what is installed before
  /// it.
  EventRouter(GLFWwindow* window, Controls& controls) : window_(window), controls_(controls) {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window,
                       [](GLFWwindow* w, int key, int, int action, int) { self(w).key(key, action); });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
      self(w).button(button, action, mods);
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { self(w).move({x, y}); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double steps) { self(w).scroll(steps); });
    glfwSetDropCallback(window,
                        [](GLFWwindow* w, int count, const char** paths) { self(w).drop(count, paths); });
  }

  void attach(Overlay& overlay) { overlay_ = &overlay; }

  /// Whether the user has done anything since the last call.
  bool takeInput() { return std::exchange(hasInput_, false); }

  const std::optional<std::filesystem::path>& dropped() const { return dropped_; }

 private:
  static EventRouter& self(GLFWwindow* window) {
    auto& router = *static_cast<EventRouter*>(glfwGetWindowUserPointer(window));
    router.hasInput_ = true;
    return router;
  }

  void key(int key, int action) {
    if (action == GLFW_RELEASE || (overlay_ != nullptr && overlay_->wantsKeys())) return;
    if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window_, GLFW_TRUE);
    if (key == GLFW_KEY_H && overlay_ != nullptr) overlay_->toggleHelp();
    if (key == GLFW_KEY_F) controls_.setShading(Shading::GlobalIllumination);
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) controls_.setShading(shadingOfKey(key - GLFW_KEY_0));
    if (const auto command = commandOf(key)) controls_.run(*command);
  }

  void button(int button, int action, int modifiers) {
    const bool taken = overlay_ != nullptr && overlay_->wantsMouse();
    drag_ = action == GLFW_PRESS && !taken ? dragOf(button, modifiers) : Drag::None;
  }

  void move(const glm::dvec2& cursor) {
    int width = 1;
    int height = 1;
    glfwGetWindowSize(window_, &width, &height);
    const glm::dvec2 delta = (cursor - cursor_) / static_cast<double>(height > 0 ? height : 1);
    cursor_ = cursor;
    controls_.drag(drag_, {delta.x, -delta.y});
  }

  void scroll(double steps) {
    if (overlay_ != nullptr && overlay_->wantsMouse()) return;
    controls_.scroll(steps, drag_ == Drag::Light);
  }

  /// Takes the first of several files.
  void drop(int count, const char** paths) {
    if (count < 1) return;
    dropped_ = paths[0];
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
  }

  GLFWwindow* window_;
  Controls& controls_;
  Overlay* overlay_ = nullptr;
  bool hasInput_ = false;
  Drag drag_ = Drag::None;
  glm::dvec2 cursor_{0.0};
  std::optional<std::filesystem::path> dropped_;
};

/// The parts of a view that the scene's animations move and the user may stop.
void setUpPlayback(const ViewerInputs& inputs, const ViewerOptions& options, const PosedScene& scene,
                   Controls& controls) {
  const std::size_t camera = static_cast<std::size_t>(options.render.camera.value_or(0));
  Following following{!options.render.lights.has_value(), std::nullopt};
  if (camera < scene.cameras().size()) following.camera = camera;
  controls.startFollowing({scene.lights(), scene.cameras()}, following);
  if (!scene.showsMoments()) return;
  Playback playback(inputs.scene);
  if (options.play.animation) playback.chooseAnimation(*options.play.animation);
  playback.setSpeed(options.play.speed);
  playback.setLoop(options.play.loops);
  if (options.play.plays) playback.toggle();
  controls.setPlayback(playback);
}

std::vector<std::string> groupNames(const ViewerInputs& inputs, const ViewerOptions& options) {
  return inputs.bake != nullptr && inputs.bake->lightGroups ? namesOf(*inputs.bake->lightGroups)
                                                            : options.groups;
}

/// How a window shows its pictures, and how many.
struct Showing {
  int frames = 0;
  double exposure = 1.0;
  std::function<void(const std::string&)> note;
};

void tellNotes(PosedScene& scene, const Showing& showing) {
  for (const std::string& note : scene.takeNotes())
    if (showing.note) showing.note(note);
}

/// The exposure that suits a view, from a small picture of it.
double meteredView(Renderer& renderer, View view) {
  constexpr int meteredHeight = 180;
  view.width = std::max(1, static_cast<int>(std::int64_t{view.width} * meteredHeight / view.height));
  view.height = meteredHeight;
  return meteredExposure(renderView(renderer, view, 1));
}

void writeScreenshot(const std::filesystem::path& path, const Picture& picture, double exposure) {
  writePicture(path, path.extension() == ".exr" ? picture : exposed(picture, exposure));
}

double secondsSince(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

/// The parts of a window that its loop keeps up to date.
struct LiveWindow {
  GLFWwindow* window;
  EventRouter& router;
  Controls& controls;
  Renderer& renderer;
  LivePicture& picture;
  PosedScene& scene;
  SceneFollower& follower;
  Overlay& overlay;
};

/// Draws what has changed in the window, a slice of its picture at least. Returns false where all is shown
/// and stays as it is until the user does something.
class WindowLoop {
 public:
  WindowLoop(const LiveWindow& parts, const Showing& showing) : parts_(parts), showing_(showing) {}

  void run() {
    const int frames = showing_.frames;
    for (int frame = 0; glfwWindowShouldClose(parts_.window) == GLFW_FALSE && (frames == 0 || frame < frames);
         ++frame) {
      takeEvents(frames > 0 || frame < 3);
      if (!fitToWindow()) continue;  // minimised
      update();
      show(frames > 0);
      const auto now = Clock::now();
      if (frames == 0)
        parts_.controls.passTime(std::chrono::duration<double>(now - lastFrame_).count());
      else if (frame + 1 < frames)
        parts_.controls.playOn(countedFrame);
      lastFrame_ = now;
    }
  }

 private:
  /// Waits for an event where nothing changes by itself.
  void takeEvents(bool goesOn) {
    const bool rests = isShown_ && parts_.picture.isFinal(parts_.controls.changes()) && !isLit_ &&
                       !parts_.renderer.isBehind() && !parts_.follower.isBusy(parts_.controls.view()) &&
                       !parts_.controls.playback().plays();
    if (goesOn || !rests) return glfwPollEvents();
    glfwWaitEventsTimeout(0.25);
    lastFrame_ = Clock::now();  // what plays from now on has not played meanwhile
  }

  bool fitToWindow() {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(parts_.window, &width, &height);
    if (width < 1 || height < 1) return false;
    parts_.controls.resize(width, height);
    return true;
  }

  /// Brings the picture up to date. Light that changes by itself is shown in drafts until it has settled.
  void update() {
    Controls& controls = parts_.controls;
    LivePicture& picture = parts_.picture;
    isLit_ = parts_.follower.update(controls);
    tellNotes(parts_.scene, showing_);
    if (controls.changes() != seen_ || isLit_) lastChange_ = Clock::now();
    seen_ = controls.changes();
    const bool settled = secondsSince(lastChange_) > settleTime && !parts_.follower.isBusy(controls.view());
    if (isLit_ || (!settled && parts_.renderer.isBehind())) picture.invalidate();
    if (settled && picture.isFinal(controls.changes()) && parts_.renderer.isBehind()) picture.refineAgain();
    const bool isDraft = !settled || !picture.isDraft();
    picture.update(controls.view(), controls.changes(), settled);
    isShown_ = isShown_ && !isDraft && !picture.isDraft();
    mustShow_ = isDraft || !picture.isDraft();
  }

  /// Slices are so short that it would take long to show each.
  void show(bool always) {
    const bool input = parts_.router.takeInput();
    if (!always && !input && !mustShow_ && secondsSince(lastShown_) < shownEvery) return;
    presenter_.present(parts_.picture.shown(), 1, 0, static_cast<float>(showing_.exposure));
    parts_.overlay.draw(parts_.controls, parts_.picture.lastSeconds());
    glfwSwapBuffers(parts_.window);
    lastShown_ = Clock::now();
    isShown_ = true;
  }

  LiveWindow parts_;
  const Showing& showing_;
  Presenter presenter_;
  Clock::time_point lastChange_ = Clock::now(), lastFrame_ = lastChange_, lastShown_ = lastChange_;
  std::size_t seen_ = 0;
  bool isLit_ = false;    ///< the last update has changed the light
  bool mustShow_ = true;  ///< the last update has drawn a draft, or the last slice
  bool isShown_ = false;  ///< the window shows what was last drawn
};

}  // namespace

std::optional<std::filesystem::path> runViewer(const ViewerInputs& inputs, const ViewerOptions& options) {
  View view = makeView(inputs, options.render);
  const GlfwSession session;
  const WindowHandle window = openWindow(options, view.width, view.height);
  PosedScene scene(inputs, options.pose);
  Renderer renderer(scene.shown(), options.render.lobe);
  SceneFollower follower(renderer, scene, options.followers, options.objects);
  if (!renderer.canShade(view.shading)) view.shading = Shading::Phong;
  const std::vector<std::string> groups = groupNames(inputs, options);
  view.groupFactors =
      groupFactors(groups, groups.empty() ? std::span<const GroupFactor>() : options.render.groups);
  Controls controls(
      view, inputs.compiled, [&](Shading shading) { return renderer.canShade(shading); }, groups,
      dragNodes(scene));
  setUpPlayback(inputs, options, scene, controls);
  controls.offer({options.objects != nullptr, inputs.probes.has_value()});
  for (std::size_t i = 0; i < scene.nodes().size(); ++i)
    if (scene.nodes()[i].node == options.selectedNode) controls.selectNode(static_cast<int>(i));
  EventRouter router(window.get(), controls);
  Overlay overlay(window.get(), inputs.environment != nullptr);
  router.attach(overlay);
  LivePicture picture(renderer, options.render.samplesPerAxis);
  const Showing showing{options.frames,
                        options.exposure ? *options.exposure : meteredView(renderer, controls.view()),
                        options.note};
  if (!options.exposure && options.metered) options.metered(showing.exposure);
  renderer.paceUpdates(true);  // after metering, which a draft would mislead
  renderer.reuseOcclusion(true);
  WindowLoop({window.get(), router, controls, renderer, picture, scene, follower, overlay}, showing).run();
  if (!router.dropped() && !options.screenshotPath.empty()) {
    renderer.paceUpdates(false);
    renderer.reuseOcclusion(false);
    writeScreenshot(options.screenshotPath,
                    renderView(renderer, controls.view(), options.render.samplesPerAxis), showing.exposure);
  }
  return router.dropped();
}

}  // namespace prelight::viewer
