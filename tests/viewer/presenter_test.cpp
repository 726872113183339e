#include "viewer/window/presenter.h"

#include <gtest/gtest.h>

#include <vector>

#include "prelight/picture.h"
#include "support/environment_variable.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"

namespace prelight::viewer {
namespace {

TEST(EglContext, WithoutADisplay_GivesOpenGl41Core) {
  const test::EnvironmentVariable x11("DISPLAY", nullptr);
  const test::EnvironmentVariable wayland("WAYLAND_DISPLAY", nullptr);
  for (int i = 0; i < 2; ++i) {
    const gl::EglContext context;
    GLint major = 0;
    GLint minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    EXPECT_GE(10 * major + minor, 41);
  }
}

TEST(Presenter, EveryColour_IsShownAsThePictureFileHasIt) {
  const gl::EglContext context;
  constexpr int size = 32;
  constexpr int samples = 2;
  std::vector<glm::vec3> colors;
  for (int i = 0; i < 4 * size * size; ++i) {
    const int pixel = i / 2 % size + size * (i / (4 * size));
    colors.emplace_back(0.004f * static_cast<float>(pixel), 2.0f - 0.002f * static_cast<float>(pixel),
                        0.1f * static_cast<float>(pixel % 7));
  }
  const gl::Framebuffer source(samples * size, samples * size);
  glBindTexture(GL_TEXTURE_2D, source.color().name());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, samples * size, samples * size, GL_RGB, GL_FLOAT, colors.data());
  Picture picture{size, size, std::vector<glm::vec3>(size * size)};
  resolve(source, samples, {0, 0, size, size}, picture);

  const gl::Framebuffer shown(size, size);
  shown.bind();
  GLint name = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &name);
  constexpr float exposure = 0.7f;
  Presenter().present(source, samples, static_cast<GLuint>(name), exposure);
  const std::vector<glm::vec4> pixels = shown.read();
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const glm::vec3 expected = toneMap(exposure * picture.pixels[y * size + x]);
      const glm::vec3 got(pixels[(size - 1 - y) * size + x]);
      EXPECT_LT(glm::length(got - expected), 2e-3f) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace prelight::viewer
