#include "viewer/gl/uploads.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/gl/texture.h"
#include "viewer/gl/timer_query.h"
#include "viewer/quad_scene.h"

namespace prelight::viewer::gl {
namespace {

class Uploads : public testing::Test {
 protected:
  void SetUp() override {
    if (!UploadCounter::works()) GTEST_SKIP() << "no debug messages below OpenGL 4.3";
  }

  EglContext context_;
};

TEST_F(Uploads, OfBuffersAndTextures_AreCountedToTheByte) {
  const std::vector<float> values(1000, 1.0f);
  const std::vector<glm::vec3> texels(16 * 8, glm::vec3(1.0f));
  const UploadCounter counter;
  const Buffer buffer(GL_ARRAY_BUFFER, std::span<const float>(values));
  EXPECT_EQ(counter.bytes(), 4000u);
  buffer.replace(GL_ARRAY_BUFFER, 400, std::span<const float>(values).first(10));
  EXPECT_EQ(counter.bytes(), 4040u);
  const Texture sky = makeFloatTexture(16, 8, texels);
  EXPECT_EQ(counter.bytes(), 4040u + 16 * 8 * 12);
  const Texture layers = makeFloatArray(4, 2, "layers");  // Only reserves memory.
  fillFloatArray(layers, {0, 0, 1}, {4, 4}, std::span<const glm::vec3>(texels).first(16));
  EXPECT_EQ(counter.bytes(), 4040u + (16 * 8 + 16) * 12);
}

TEST_F(Uploads, BeforeAndAfterACounter_AreNotItsOwn) {
  const std::vector<float> values(10, 1.0f);
  const Buffer before(GL_ARRAY_BUFFER, std::span<const float>(values));
  {
    const UploadCounter counter;
    EXPECT_EQ(counter.bytes(), 0u);
  }
  const Buffer between(GL_ARRAY_BUFFER, std::span<const float>(values));
  const UploadCounter later;
  EXPECT_EQ(later.bytes(), 0u);
}

TEST_F(Uploads, OfASecondPicture_AreItsUniformBlocksAlone) {
  test::QuadScene quad;
  quad.add(test::lambertian(glm::vec3(0.5f)));
  quad.scene.lights.push_back(test::makeLight(LightType::Point, glm::vec3(1.0f), {0, 0, 1}));
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.compile();
  const RenderInputs inputs = quad.inputs();
  const View view = makeView(inputs, test::square());
  const UploadCounter counter;
  Renderer renderer(inputs);
  renderView(renderer, view, 1);
  const std::size_t first = counter.bytes();
  renderView(renderer, view, 1);
  const std::size_t second = counter.bytes() - first;
  renderView(renderer, view, 1);
  EXPECT_EQ(counter.bytes() - first, 2 * second);
  EXPECT_GT(second, 0u);
  EXPECT_GT(first, second + 4 * 3 * sizeof(float));  // The first upload includes its vertices.
}

TEST_F(Uploads, TimerQuery_OfAPicture_IsLongerThanOfNothing) {
  const TimerQuery nothing, something;
  nothing.begin();
  nothing.end();
  const Framebuffer target(1024, 1024);
  something.begin();
  for (int i = 0; i < 20; ++i) {
    target.bind();
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }
  Framebuffer::finish();
  something.end();
  EXPECT_GT(something.seconds(), nothing.seconds());
}

}  // namespace
}  // namespace prelight::viewer::gl
