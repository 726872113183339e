#include "viewer/programs/sliced_drawing.h"

#include <epoxy/gl.h>

#include <chrono>

namespace prelight::viewer {

SlicedWork drawInSlices(int width, int height, double seconds, std::function<void(const SampleRect&)> draw) {
  using Clock = std::chrono::steady_clock;
  PictureSlices slices(width, height, seconds);
  while (!slices.done()) {
    const SampleRect rect = slices.next();
    const auto start = Clock::now();
    if (slices.isSliced()) {
      glEnable(GL_SCISSOR_TEST);
      glScissor(rect.x, rect.y, rect.width, rect.height);
    }
    draw(rect);
    if (slices.isSliced()) {
      glDisable(GL_SCISSOR_TEST);
      glFinish();
    }
    slices.drew(std::chrono::duration<double>(Clock::now() - start).count());
    if (slices.isSliced()) co_await endOfSlice;
  }
}

}  // namespace prelight::viewer
