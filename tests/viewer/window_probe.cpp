// Opens the window on the scene of window_scene.h: window_probe SCREENSHOT FRAMES [DROPPED]. In its first
// frame the file DROPPED is dropped on it, as the display would do, and the window's response goes to stdout.
// Run by window_test.cpp.
#define GLFW_INCLUDE_NONE  // The viewer's headers declare OpenGL.
#include <GLFW/glfw3.h>

#include <cstdlib>
#include <iostream>

#include "prelight/error.h"
#include "viewer/window/window.h"
#include "viewer/window_scene.h"

namespace {

/// Drops a file as soon as the window draws.
class Dropper final : public prelight::viewer::LightFollower {
 public:
  explicit Dropper(const char* path) : path_(path) {}

  prelight::viewer::Shading shading() const override { return prelight::viewer::Shading::Phong; }
  bool update(const prelight::viewer::FollowedView&) override {
    GLFWwindow* window = glfwGetCurrentContext();
    const GLFWdropfun drop = glfwSetDropCallback(window, nullptr);
    if (drop != nullptr) drop(window, 1, &path_);
    return false;
  }
  void show(prelight::viewer::Renderer&) const override {}

 private:
  const char* path_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) return 2;
  try {
    const auto scene = prelight::test::windowScene();
    prelight::viewer::ViewerOptions options;
    options.render = prelight::test::windowOptions();
    options.title = prelight::test::windowTitle;
    options.screenshotPath = argv[1];
    options.frames = std::atoi(argv[2]);
    Dropper dropper(argc == 4 ? argv[3] : "");
    if (argc == 4) options.followers.push_back(&dropper);
    if (const auto dropped = prelight::viewer::runViewer(scene.inputs(), options))
      std::cout << dropped->string() << '\n';
    return 0;
  } catch (const prelight::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
