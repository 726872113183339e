// Opens the window on the scene of window_scene.h: window_probe SCREENSHOT FRAMES. Driven by window_test.cpp.
#include <cstdlib>
#include <iostream>

#include "prelight/error.h"
#include "viewer/window.h"
#include "viewer/window_scene.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const auto scene = prelight::test::windowScene();
    prelight::viewer::ViewerOptions options;
    options.render = prelight::test::windowOptions();
    options.title = prelight::test::windowTitle;
    options.screenshotPath = argv[1];
    options.frames = std::atoi(argv[2]);
    return prelight::viewer::runViewer(scene.inputs(), options);
  } catch (const prelight::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
