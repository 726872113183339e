// Draft pictures of views that move, and the tiles in which pictures are drawn.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/programs/frame_pass.h"
#include "viewer/quad_scene.h"
#include "viewer/window_scene.h"

namespace prelight::viewer {
namespace {

using namespace test;

/// A floor under a lamp: the floor's radiance is the only visible light of the lamp.
QuadScene litFloor() {
  QuadScene quad;
  quad.add(lambertian(glm::vec3(0.7f)), 1.0f);
  Material lamp = lambertian(glm::vec3(0.0f));
  lamp.emission = {5, 4, 3};
  lamp.doubleSided = true;
  quad.add(lamp, 0.2f, glm::translate(glm::dmat4(1.0), glm::dvec3(1.6, 0.0, 1.0)));
  quad.lookFrom({-0.2, 0, 2.5}, {-0.2, 0, 0});
  quad.compile();
  return quad;
}

// Compares four samples of a lamp of 0.4 m at 1 m with 32.
TEST(Draft, OfALamp_HasTheLightOfTheStillPicture) {
  const gl::EglContext context;
  const QuadScene quad = litFloor();
  const RenderInputs inputs = quad.inputs();
  Renderer renderer(inputs);
  View view = makeView(inputs, square());
  const Picture still = renderView(renderer, view, 1);
  view.draft = true;
  const Picture draft = renderView(renderer, view, 1);
  EXPECT_GT(largestDifference(draft, still), 0.0);
  for (const double x : {0.3, 0.5, 0.7}) expectColor(pixelAt(draft, x, 0.5), pixelAt(still, x, 0.5), 0.03);
}

TEST(FramePasses, AreToldInTheirOrder_CausticsOnlyWhereThereArePhotons) {
  const gl::EglContext context;
  const QuadScene quad = windowScene();
  const Caustics none;
  device::Photon photon{};
  photon.power[0] = 1.0f;
  const std::vector<device::Photon> photons(1, photon);
  const Caustics some{photons, {}};
  for (const Caustics* caustics : {&none, &some}) {
    RenderInputs inputs = quad.inputs();
    inputs.caustics = caustics;
    Renderer renderer(inputs);
    std::vector<FramePass> passes;
    renderer.observePasses([&](const DrawnPass& drawn) { passes.push_back(drawn.pass); });
    renderView(renderer, makeView(inputs, square()), 1);
    std::vector<FramePass> expected = {FramePass::Transfer, FramePass::ShadowMaps, FramePass::Opaque,
                                       FramePass::Blended};
    if (caustics == &some) expected.insert(expected.begin() + 2, FramePass::Caustics);
    EXPECT_EQ(passes, expected);
  }
}

}  // namespace
}  // namespace prelight::viewer
